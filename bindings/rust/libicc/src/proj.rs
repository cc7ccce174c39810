//! Maps as PROJ reads them: <https://proj.org/en/stable/operations/transformations/tinshift.html>
use crate::error::{Error, Result, Status};
use crate::map::Map;

impl Map {
    /// The mesh of a mesh map in the plane as a triangulation for PROJ, in JSON. Save it to a file, and PROJ applies it
    /// by `+proj=tinshift +file=FILE`. So do programs that use PROJ, such as GDAL, QGIS and PostGIS. The names of
    /// reference systems, such as `EPSG:2056`, are only recorded; they transform nothing.
    ///
    /// # Errors
    /// [`Status::UNSUPPORTED`] for other maps.
    pub fn to_proj(&self, source_crs: Option<&str>, target_crs: Option<&str>) -> Result<String> {
        if self.dim() != 2 {
            return Err(Error::bare(Status::UNSUPPORTED.0));
        }
        let mesh = self.mesh()?;
        let ends = mesh.vertices.chunks(2).zip(mesh.images.chunks(2));
        Ok(format!(
            concat!(
                "{{\n\"file_type\": \"triangulation_file\",\n\"format_version\": \"1.1\",\n",
                "\"publisher\": \"libicc {}\",\n{}{}",
                "\"transformed_components\": [\"horizontal\"],\n\"fallback_strategy\": \"none\",\n",
                "\"vertices_columns\": [\"source_x\", \"source_y\", \"target_x\", \"target_y\"],\n",
                "\"triangles_columns\": [\"idx_vertex1\", \"idx_vertex2\", \"idx_vertex3\"],\n",
                "\"vertices\": [\n{}],\n\"triangles\": [\n{}]\n}}\n"
            ),
            crate::version(),
            member("input_crs", source_crs),
            member("output_crs", target_crs),
            rows(ends.map(|(v, w)| format!("[{}, {}, {}, {}]", v[0], v[1], w[0], w[1]))),
            rows(mesh.simplices.chunks(3).map(|t| format!("[{}, {}, {}]", t[0], t[1], t[2]))),
        ))
    }
}

fn rows(rows: impl Iterator<Item = String>) -> String {
    rows.collect::<Vec<_>>().join(",\n")
}

/// A member of an object and the comma behind it, or nothing.
fn member(name: &str, text: Option<&str>) -> String {
    text.map_or(String::new(), |text| format!("\"{name}\": \"{}\",\n", escaped(text)))
}

/// A text in a string of JSON.
fn escaped(text: &str) -> String {
    let mut result = String::new();
    for c in text.chars() {
        match c {
            '"' | '\\' => result.extend(['\\', c]),
            c if c < ' ' => result += &format!("\\u{:04x}", u32::from(c)),
            c => result.push(c),
        }
    }
    result
}
