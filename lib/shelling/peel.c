#include "shelling/order.h"
