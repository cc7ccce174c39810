/* The version of the library. CMakeLists.txt reads it from here. cmake/dist_facts.sh copies it to
 * the files that repeat it. */
#ifndef ICCP_VERSION_H
#define ICCP_VERSION_H

#define ICCP_VERSION_MAJOR 0
#define ICCP_VERSION_MINOR 1
#define ICCP_VERSION_PATCH 0

#endif
