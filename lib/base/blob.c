#include "base/blob.h"
