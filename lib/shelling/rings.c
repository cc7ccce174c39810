#include "shelling/rings.h"
