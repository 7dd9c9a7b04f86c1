/// --example NAME: a study that is shipped, in the place of STUDY.yaml.
#ifndef BT_CLI_EXAMPLE_H
#define BT_CLI_EXAMPLE_H

#include "cli/cli.h"

/// Puts the file of the example that the command names where its verb expects the study:
/// "reference" is studies/reference/study.yaml, "rigs/currey" is studies/rigs/currey.yaml, both of
/// the installed share/bolter or of the source tree that the program was built in. Its results go
/// into a directory of that name here, unless -o says otherwise. False: there is none, or the verb
/// has an argument too many (said).
bool bt_example_take(bt_command* command);

#endif
