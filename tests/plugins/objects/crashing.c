/* SPDX-License-Identifier: MIT */
/* Ends the program while it is loaded. */
#include <unistd.h>

__attribute__ ((constructor)) static void crash (void) { _exit (77); }
