#include "commands.h"
int run_pose(const args *a) { (void)a; return 1; }
