#include "domain/simplices.h"
