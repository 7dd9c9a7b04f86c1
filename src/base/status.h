/// Status codes, which are part of the public interface.
#ifndef BT_BASE_STATUS_H
#define BT_BASE_STATUS_H

#include "bolter/status.h"

#endif
