#include "report/page.h"

#include "base/directory.h"
#include "report/page_parts.h"
#include "report/page_shell.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool bt_page_available(bt_diag* diag) {
    bt_span before, after;
    if (bt_page_shell(&before, &after))
        return true;
    bt_diag_add(diag, BT_ERROR, BT_NOWHERE,
                "this bolter was built without its report page: node and npm were missing, or the "
                "packages of web/package-lock.json could not be fetched; everything else works");
    return false;
}

// --- file -------------------------------------------------------------------------------------

/// Length of what every page of ours begins with.
static size_t mark_length(const bt_span* before) {
    static const char end[] = "-->";
    const char* at = strstr(before->text, end);
    return at && at < before->text + before->size ? (size_t)(at - before->text) + sizeof end - 1
                                                  : before->size;
}

/// Writes data into the page and the page to the path, unless that is a file of the user's.
static bt_status store(const bt_study* study, const char* path, const char* data, size_t size,
                       bt_diag* diag) {
    bt_span before, after;
    if (!bt_page_shell(&before, &after))
        return BT_ERR_INPUT;
    if (bt_study_reads(study, path))
        return bt_file_refuse(path, diag);
    char* text = malloc(before.size + size + after.size);
    if (!text)
        return BT_ERR_MEMORY;
    memcpy(text, before.text, before.size);
    memcpy(text + before.size, data, size);
    memcpy(text + before.size + size, after.text, after.size);
    const bt_status status =
        bt_file_replace(path, text, before.size + size + after.size, mark_length(&before), diag);
    free(text);
    return status;
}

typedef bt_status writer(bt_page* page, const void* user);

/// Lets a function write the data, then stores the page.
static bt_status make(const bt_page_subject* subject, const char* path, writer* write,
                      const void* user, bt_diag* diag) {
    if (!bt_page_available(diag))
        return BT_ERR_INPUT;
    char* data = NULL;
    size_t size = 0;
    FILE* out = open_memstream(&data, &size);
    if (!out)
        return BT_ERR_MEMORY;
    bt_json json = {.out = out, .in_page = true};
    bt_page page = {.json = &json, .subject = subject, .diag = diag};
    bt_json_begin_object(&json, NULL);
    bt_json_string(&json, "title", subject->study->title);
    bt_status status = write(&page, user);
    bt_json_end_object(&json);
    bt_landings_destroy(&page.landings);
    if (fclose(out) != 0 && status == BT_OK)
        status = BT_ERR_MEMORY;
    if (status == BT_OK)
        status = store(subject->study, path, data, size, diag);
    free(data);
    return status;
}

// --- one landing ------------------------------------------------------------------------------

typedef struct one_landing {
    const bt_playback* playback;
    const bt_page_landing_of* of;
} one_landing;

static bt_status write_landing(bt_page* page, const void* user) {
    const one_landing* one = user;
    bt_json_begin_array(page->json, "playback");
    BT_TRY(bt_playback_write(page->json, one->playback, one->of->run, one->of->name, one->of->model,
                             one->of->result, page->diag));
    bt_json_end_array(page->json);
    bt_page_study_write(page);
    return BT_OK;
}

bt_status bt_page_landing(const bt_page_subject* subject, const char* path,
                          const bt_playback* playback, const bt_page_landing_of* landing,
                          bt_diag* diag) {
    const one_landing one = {playback, landing};
    return make(subject, path, write_landing, &one, diag);
}

// --- report -----------------------------------------------------------------------------------

/// reliability.json of the study directory as it is; nothing when there is none.
static void write_reliability(bt_page* page) {
    char path[BT_FILE_PATH_MAX], *text = NULL;
    if (bt_file_path(path, page->subject->study->directory, "reliability.json") != BT_OK ||
        bt_file_read(path, &text, NULL, NULL) != BT_OK)
        return;
    bt_json_text(page->json, "reliability", text);
    free(text);
}

static bt_status write_report(bt_page* page, const void* user) {
    (void)user;
    bt_json_bool(page->json, "reference_study", bt_study_is_reference(page->subject->study));
    BT_TRY(bt_page_landings_read(page));
    bt_page_landings_write(page);
    write_reliability(page);
    bt_page_atlas_write(page);
    BT_TRY(bt_page_playback_write(page));
    BT_TRY(bt_page_surrogate_write(page));
    BT_TRY(bt_page_bounces_write(page));
    BT_TRY(bt_page_rigs_write(page));
    bt_page_study_write(page);
    return BT_OK;
}

bt_status bt_page_report(const bt_page_subject* subject, const char* path, bt_diag* diag) {
    return make(subject, path, write_report, NULL, diag);
}
