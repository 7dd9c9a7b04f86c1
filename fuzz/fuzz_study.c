/// The study reader under libFuzzer: any text is read or refused with a reason, and what is read
/// reads back from its echo to the same study.
///
///     fuzz_study fuzz/seeds/study
#include "study/study.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    bt_study study, again;
    bt_diag diag = {0};
    const bt_status status =
        bt_study_read_text("fuzz.yaml", (const char*)data, size, NULL, 0, &study, &diag);
    if ((status == BT_OK) != (diag.errors == 0))
        abort(); // refused without a word, or accepted with a complaint
    if (status != BT_OK)
        return 0;
    if (bt_study_read_text("echo.yaml", study.text, strlen(study.text), NULL, 0, &again, &diag) !=
            BT_OK ||
        again.hash != study.hash)
        abort();
    bt_study_destroy(&again);
    bt_study_destroy(&study);
    return 0;
}
