/* The version of the library. CMakeLists.txt reads it from here; it is written nowhere else. */
#ifndef ICCP_VERSION_H
#define ICCP_VERSION_H

#define ICCP_VERSION_MAJOR 0
#define ICCP_VERSION_MINOR 1
#define ICCP_VERSION_PATCH 0

#endif
