/* Moves the joints of a glTF scene with its meshes. */
#ifndef GLB_JOINTS_H
#define GLB_JOINTS_H

#include "base/edits.h"
#include "mesh/glb.h"
#include "mesh/mesh_carry.h"

/* Moves each joint to the image of its place. Changes the inverse bind matrices and the
 * translations of joints in animations in `text`, a copy of the scene's text. Adds the changes of
 * the JSON at places in that chunk. n vectors are written to the same text. Without a mover it only
 * looks for skins and animations. Skins that cannot be moved stay, and `out` tells why. False: see
 * `wrong`. If its text is empty, the mover has printed a message. */
bool glb_carry_joints(const glb *g, size_t dim, char *text, size_t n_text, size_t n,
                      const glb_vectors *vectors, edits *e, const mesh_mover *mover,
                      mesh_carried *out, problem *wrong);

#endif
