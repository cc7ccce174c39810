#include "commands.h"

#include "say.h"

int run_plot(const args *a) {
    return misused(a->command, "not available yet");
}
