#include "bolter/version.h"

#define TEXT(x) #x
#define VERSION(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

const char* bt_version(void) {
    return VERSION(BT_VERSION_MAJOR, BT_VERSION_MINOR, BT_VERSION_PATCH);
}
