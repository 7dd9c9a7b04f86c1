/// The report page as it was bundled from web/: one HTML text with a place for its data.
#ifndef BT_REPORT_PAGE_SHELL_H
#define BT_REPORT_PAGE_SHELL_H

#include <stdbool.h>
#include <stddef.h>

/// A piece of text that is not ended by a zero byte.
typedef struct bt_span {
    const char* text;
    size_t size;
} bt_span;

/// What stands before the page's data and after them. False when this build has no page: node or
/// npm, or the packages that it needs, were not there.
bool bt_page_shell(bt_span* before, bt_span* after);

#endif
