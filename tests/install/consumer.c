#include "consumer.h"

int main(int argc, char **argv)
{
    return argc == 2 ? use_library(argv[1]) : 2;
}
