/* The function of a foliation as part of the bytes of charts; see docs/formats.md. */
#ifndef ICCP_PSI_FILE_H
#define ICCP_PSI_FILE_H

#include "base/blob.h"
#include "foliation/psi.h"

void iccp_psi_write(const iccp_psi *psi, const iccp_planar *mesh, iccp_blob *w);

/* Reads the rises, which is all that leaves follow; labels are left out. ICC_ERR_FORMAT if the
 * centre is no vertex inside or sums of rises could overflow: what else they are is for
 * iccp_certify_psi(). */
icc_status iccp_psi_read(iccp_psi *psi, const iccp_planar *mesh, iccp_blob *r, const iccp_env *env);

#endif
