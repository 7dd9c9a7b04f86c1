#include "near.h"

#include "base/arena.h"

static void pieces_are_zeroed_aligned_and_apart(void** state) {
    (void)state;
    bt_arena arena;
    assert_int_equal(bt_arena_create(&arena, 4096), BT_OK);
    unsigned char* last = NULL;
    for (int i = 1; i < 8; ++i) {
        unsigned char* piece = bt_arena_take(&arena, (size_t)(i * 13));
        assert_non_null(piece);
        assert_int_equal((uintptr_t)piece % 64, 0);
        for (int k = 0; k < i * 13; ++k)
            assert_int_equal(piece[k], 0);
        if (last)
            assert_true(piece >= last + (i - 1) * 13);
        memset(piece, 0xaa, (size_t)(i * 13));
        last = piece;
    }
    bt_arena_destroy(&arena);
}

static void what_is_given_back_is_zeroed_again(void** state) {
    (void)state;
    bt_arena arena;
    assert_int_equal(bt_arena_create(&arena, 1024), BT_OK);
    double* kept = BT_TAKE(&arena, double, 4);
    kept[0] = 7;
    const size_t mark = arena.used;
    double* first = BT_TAKE(&arena, double, 8);
    memset(first, 0xff, 8 * sizeof *first);
    bt_arena_reset(&arena, mark);
    double* second = BT_TAKE(&arena, double, 8);
    assert_ptr_equal(first, second);
    for (int i = 0; i < 8; ++i)
        assert_true(second[i] == 0);
    assert_true(kept[0] == 7);
    assert_true(arena.peak >= arena.used);
    bt_arena_destroy(&arena);
}

static void a_full_arena_gives_null_and_stays_usable(void** state) {
    (void)state;
    bt_arena arena;
    assert_int_equal(bt_arena_create(&arena, 256), BT_OK);
    assert_null(bt_arena_take(&arena, 257));
    assert_null(bt_arena_take(&arena, SIZE_MAX));
    assert_null(bt_arena_take(&arena, SIZE_MAX - 63));
    assert_non_null(bt_arena_take(&arena, 256));
    assert_null(bt_arena_take(&arena, 1));
    bt_arena_reset(&arena, 0);
    assert_non_null(bt_arena_take(&arena, 1));
    bt_arena_destroy(&arena);
}

static void a_zeroed_arena_may_be_destroyed(void** state) {
    (void)state;
    bt_arena arena = {0};
    bt_arena_destroy(&arena);
    assert_null(bt_arena_take(&arena, 1));
}

/// The address sanitizer stops at such a request unless told that NULL is an answer.
__attribute__((visibility("default"))) const char* __asan_default_options(void);
const char* __asan_default_options(void) {
    return "allocator_may_return_null=1";
}

static void a_size_that_no_system_has_is_an_error(void** state) {
    (void)state;
    bt_arena arena;
    assert_int_equal(bt_arena_create(&arena, SIZE_MAX / 2), BT_ERR_MEMORY);
    bt_arena_destroy(&arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_are_zeroed_aligned_and_apart),
        cmocka_unit_test(what_is_given_back_is_zeroed_again),
        cmocka_unit_test(a_full_arena_gives_null_and_stays_usable),
        cmocka_unit_test(a_zeroed_arena_may_be_destroyed),
        cmocka_unit_test(a_size_that_no_system_has_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
