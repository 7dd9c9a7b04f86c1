#include "base/status.h"

const char* bt_status_text(bt_status status) {
    static const char* const text[BT_STATUS_COUNT] = {
#define X(name, sentence) sentence,
        BT_STATUS_LIST(X)
#undef X
    };
    if ((unsigned)status >= BT_STATUS_COUNT)
        return "unknown status";
    return text[status];
}
