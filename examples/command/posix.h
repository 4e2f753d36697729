/* posix.h - what the commands take of POSIX, where it is: isatty, read, poll and stat, to tell a terminal from a file,
   to take what a pipe holds, to know a file by whatever name. Elsewhere they do without a progress line, rows may come
   late, and files are known by name alone. To be included before anything else. */
#ifndef SURFMINK_COMMAND_POSIX_H
#define SURFMINK_COMMAND_POSIX_H

#ifndef HAS_POSIX
#if defined(__unix__) || defined(__APPLE__)
#define HAS_POSIX 1
#else
#define HAS_POSIX 0
#endif
#endif
#if HAS_POSIX && !defined(_POSIX_C_SOURCE)
#define _POSIX_C_SOURCE 200112L
#endif
#if HAS_POSIX
#include <sys/stat.h>
#include <unistd.h>
#endif

#endif
