/* What a benchmark prints arrives line by line, through a pipe and in a file too, so that a long run shows where it is.
 * Linked to each of them. */
#include <stdio.h>

__attribute__((constructor)) static void print_by_lines(void)
{
    setvbuf(stdout, NULL, _IOLBF, 0);
}
