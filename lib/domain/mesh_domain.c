#include "domain/mesh_domain.h"
