/// Status codes: every function that can fail returns one.
#ifndef BOLTER_STATUS_H
#define BOLTER_STATUS_H

#define BT_STATUS_LIST(X)                                                                          \
    X(BT_OK, "success")                                                                            \
    X(BT_ERR_ARG, "argument out of its documented range")                                          \
    X(BT_ERR_INPUT, "input rejected")                                                              \
    X(BT_ERR_NUMERIC, "the computation diverged or produced a non-finite value")                   \
    X(BT_ERR_IO, "a file could not be read or written")                                            \
    X(BT_ERR_MEMORY, "out of memory")                                                              \
    X(BT_ERR_INTERRUPTED, "interrupted; everything finished so far is kept")                       \
    X(BT_ERR_FAILED_RUNS, "more runs failed than the study allows")                                \
    X(BT_ERR_INTERNAL, "internal error")

typedef enum bt_status {
#define X(name, text) name,
    BT_STATUS_LIST(X)
#undef X
        BT_STATUS_COUNT
} bt_status;

#ifdef __cplusplus
extern "C" {
#endif

/// One sentence for people; never NULL.
__attribute__((visibility("default"))) const char* bt_status_text(bt_status status);

#ifdef __cplusplus
}
#endif

#define BT_CHECKED __attribute__((warn_unused_result))

/// Passes an error up. Never compiled out. Not between an acquisition and its release.
#define BT_TRY(expr)                                                                               \
    do {                                                                                           \
        bt_status bt_try_ = (expr);                                                                \
        if (bt_try_ != BT_OK)                                                                      \
            return bt_try_;                                                                        \
    } while (0)

#endif
