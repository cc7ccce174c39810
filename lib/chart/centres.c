#include "chart/centres.h"
