#include "shelling/circulation.h"
