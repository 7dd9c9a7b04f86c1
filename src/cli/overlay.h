/// --set @FILE: a file of lines "PATH: VALUE # comment", as `bolter calibrate` writes it.
#ifndef BT_CLI_OVERLAY_H
#define BT_CLI_OVERLAY_H

#include "cli/cli.h"

/// Reads a file and adds each of its lines to the command as if --set had been given for it. On a
/// mistake says where, as file:line, and returns BT_ERR_INPUT or BT_ERR_IO.
BT_CHECKED bt_status bt_overlay_read(bt_command* command, const char* file);

#endif
