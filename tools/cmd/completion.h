/* Completes the command line in a shell, from the tables of commands and options. */
#ifndef COMPLETION_H
#define COMPLETION_H

#include "job/args.h"

#include <stddef.h>

/* Prints the script for a shell: bash, zsh or fish. */
int completion_print(const char *shell, size_t n, const command *commands);

#endif
