#define _GNU_SOURCE /* memmem */
#include "report/page_shell.h"

#include <string.h>

#ifdef BT_PAGE_FILE

__asm__(".section .rodata\n"
        ".global bt_page_text, bt_page_text_end\n"
        ".hidden bt_page_text, bt_page_text_end\n"
        "bt_page_text:\n"
        ".incbin \"" BT_PAGE_FILE "\"\n"
        "bt_page_text_end:\n"
        ".previous\n");
extern const char bt_page_text[], bt_page_text_end[];

bool bt_page_shell(bt_span* before, bt_span* after) {
    static const char mark[] = "@DATA@";
    const size_t size = (size_t)(bt_page_text_end - bt_page_text);
    const char* at = memmem(bt_page_text, size, mark, sizeof mark - 1);
    if (!at)
        return false;
    *before = (bt_span){bt_page_text, (size_t)(at - bt_page_text)};
    at += sizeof mark - 1;
    *after = (bt_span){at, (size_t)(bt_page_text_end - at)};
    return true;
}

#else

bool bt_page_shell(bt_span* before, bt_span* after) {
    *before = *after = (bt_span){"", 0};
    return false;
}

#endif
