/* The function psi as part of the bytes of a chart. Format: docs/reference/formats.md. */
#ifndef ICCP_PSI_FILE_H
#define ICCP_PSI_FILE_H

#include "base/blob.h"
#include "foliation/psi.h"

void iccp_psi_write(const iccp_psi *psi, const iccp_planar *mesh, iccp_blob *w);

/* Reads the rises. Leaves need nothing else, so labels are left out. Fails with ICC_ERR_FORMAT
 * if the centre is not an inside vertex, or if sums of rises could overflow. iccp_certify_psi()
 * checks the rest. */
icc_status iccp_psi_read(iccp_psi *psi, const iccp_planar *mesh, iccp_blob *r, const iccp_env *env);

#endif
