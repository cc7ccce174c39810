#include "shelling/element.h"
