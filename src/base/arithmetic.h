/// Whether the processor computes as the program's promise of equal bits needs it to.
#ifndef BT_BASE_ARITHMETIC_H
#define BT_BASE_ARITHMETIC_H

/// NULL when doubles round to nearest and denormal numbers are kept, on the calling thread;
/// otherwise a sentence that says what is wrong. (Threads inherit the modes of the one that starts
/// them.)
const char* bt_arithmetic_fault(void);

#endif
