# Below pictures of what the studio does, the studio in that mode. Before links.sed.
/images\/\(studio\|fox\|eye\)\.png/a @htmlonly <iframe src="studio.html#cage" title="The studio: a cage to drag" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/images\/\(star-weight\|butterfly\)\.png/a @htmlonly <iframe src="studio.html#handles" title="The studio: handles to drag" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/\.\.\/images\/stages\.png/a @htmlonly <iframe src="studio.html#stages" title="The studio: the papers' steps" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
/images\/beam\.png/a @htmlonly <iframe src="studio.html#space" title="The studio: a bar to bend" loading="lazy" style="width:100%;height:760px;border:0"></iframe> @endhtmlonly
