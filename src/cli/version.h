/// What this program is and what it was made with.
#ifndef BT_CLI_VERSION_H
#define BT_CLI_VERSION_H

#include <stdbool.h>
#include <stdio.h>

/// "bolter 0.1.0"; verbose: compiler, flags, libraries and the kernel level in use.
void bt_version_print(FILE* out, bool verbose);

/// Compiler and flags of the program.
const char* bt_version_build(void);

#endif
