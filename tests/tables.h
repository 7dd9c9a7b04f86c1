/// Rows of the tables in docs/verification.md, printed when the environment variable BT_TABLES is
/// set (scripts/verification.sh collects them), and a check that prints its row.
#ifndef BT_TESTS_TABLES_H
#define BT_TESTS_TABLES_H

#include "near.h"

#include <stdio.h>
#include <stdlib.h>

/// | problem | quantity | got | reference | error | tolerance | source |
#define BT_TABLE_ROW(problem, quantity, got, reference, tolerance, source)                         \
    do {                                                                                           \
        if (getenv("BT_TABLES")) {                                                                 \
            const double row_got_ = (got), row_reference_ = (reference);                           \
            printf("| %s | %s | %.10g | %.10g | %.1e | %.1e | %s |\n", (problem), (quantity),      \
                   row_got_, row_reference_, fabs(row_got_ - row_reference_), (double)(tolerance), \
                   (source));                                                                      \
            fflush(stdout);                                                                        \
        }                                                                                          \
    } while (0)

/// Prints the row and fails when the error is larger than the (absolute) tolerance.
#define BT_VERIFY(problem, quantity, got, reference, tolerance, source)                            \
    do {                                                                                           \
        const double verify_got_ = (got), verify_reference_ = (reference);                         \
        BT_TABLE_ROW(problem, quantity, verify_got_, verify_reference_, tolerance, source);        \
        if (!(fabs(verify_got_ - verify_reference_) <= (tolerance)))                               \
            fail_msg("%s, %s: %.17g, expected %.17g within %g", (problem), (quantity),             \
                     verify_got_, verify_reference_, (double)(tolerance));                         \
    } while (0)

#endif
