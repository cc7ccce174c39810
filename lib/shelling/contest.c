#include "shelling/contest.h"
