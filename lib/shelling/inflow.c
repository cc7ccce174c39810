#include "shelling/reference.h"
