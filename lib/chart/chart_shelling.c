#include "chart/chart_shelling.h"
