/* The version: the only place where it is written down. CMakeLists.txt reads it from here. */
#ifndef ICCP_VERSION_H
#define ICCP_VERSION_H

#define ICCP_VERSION_MAJOR 0
#define ICCP_VERSION_MINOR 1
#define ICCP_VERSION_PATCH 0

#endif
