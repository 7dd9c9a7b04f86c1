/// Benchmarks: every row is measured in this run, beside its peer where the peer is a library at
/// hand; the minimum over repeats is reported.
#ifndef BT_BENCH_BENCH_H
#define BT_BENCH_BENCH_H

/// Seconds of a monotonic clock.
double bench_now_s(void);

/// One row: own value, the peer's (peer NULL: none), their ratio (above 1: better than the peer,
/// for rates and for times alike), and the target (0: none).
void bench_row(const char* name, double value, const char* unit, const char* peer,
               double peer_value, double target);

/// Keeps the compiler from dropping work whose result is not used.
void bench_keep(const void* pointer);

void bench_mechanics(void);
void bench_cable(void);
void bench_landing(void);
void bench_campaign(void);
void bench_ledger(void);
void bench_rigs(void);
void bench_surrogate(void);
void bench_calibration(void);

#endif
