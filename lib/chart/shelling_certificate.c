#include "chart/shelling_certificate.h"
