/// The body of predict_kernel.c, written once for float and double. Before inclusion define
///   REAL, INTEGER       the number type and the unsigned integer of its size
///   NAME(word), KERNEL  the names of this copy, and the word in the name of its one export
///   EXPONENT_SHIFT      bits of the fraction
///   LEAST_EXPONENT      below it 2^y is taken as 0
///   ROUNDER             1.5 * 2^EXPONENT_SHIFT: adding it rounds to an integer
///   EXP2_COEFFICIENTS   of 2^f on [-1/2, 1/2], lowest power first
/// No include guard: it is meant to be included twice.

#define LANES (BT_VECTOR_BYTES / (int)sizeof(REAL))
#define PARTS (BT_PREDICT_GROUP / LANES)

typedef REAL NAME(vector) __attribute__((vector_size(BT_VECTOR_BYTES)));
typedef INTEGER NAME(bits) __attribute__((vector_size(BT_VECTOR_BYTES)));

/// 2^y for y <= 0: 2^n 2^f with n = round(y), |f| <= 1/2, 2^n put into the exponent bits.
static inline __attribute__((always_inline)) NAME(vector) NAME(exp2)(NAME(vector) y) {
    static const REAL c[] = {EXP2_COEFFICIENTS};
    const NAME(vector) rounded = y + ROUNDER;
    const NAME(vector) f = y - (rounded - ROUNDER);
    NAME(vector) p = f * c[sizeof c / sizeof c[0] - 1];
    for (int i = (int)(sizeof c / sizeof c[0]) - 2; i > 0; --i)
        p = (p + c[i]) * f;
    p += c[0];
    const NAME(bits) scaled = (NAME(bits))p + ((NAME(bits))rounded << EXPONENT_SHIFT);
    return (NAME(vector))(scaled & (NAME(bits))(y > LEAST_EXPONENT));
}

/// Adds the lanes of one point's sixteen running sums: halves onto each other.
static inline REAL NAME(join)(const REAL lane[BT_PREDICT_GROUP]) {
    REAL sum[BT_PREDICT_GROUP];
    for (int i = 0; i < BT_PREDICT_GROUP; ++i)
        sum[i] = lane[i];
    for (int half = BT_PREDICT_GROUP / 2; half > 0; half /= 2)
        for (int i = 0; i < half; ++i)
            sum[i] += sum[i + half];
    return sum[0];
}

/// One tile of points against the groups of one sign.
static inline __attribute__((always_inline)) void NAME(tile)(const REAL* restrict block, int groups,
                                                             int dims, const REAL* restrict x,
                                                             REAL* restrict sums) {
    NAME(vector) total[BT_PREDICT_TILE][PARTS] = {0};
    for (int g = 0; g < groups; ++g, block += (dims + 1) * BT_PREDICT_GROUP) {
        const NAME(vector)* row = (const NAME(vector)*)(const void*)block;
#pragma GCC unroll 16
        for (int part = 0; part < PARTS; ++part) {
#pragma GCC unroll 16
            for (int i = 0; i < BT_PREDICT_TILE; ++i) {
                NAME(vector) y = {0};
#pragma GCC unroll 8
                for (int k = 0; k < dims; ++k) {
                    const NAME(vector) apart = row[k * PARTS + part] - x[i * dims + k];
                    y -= apart * apart;
                }
                total[i][part] += row[dims * PARTS + part] * NAME(exp2)(y);
            }
        }
    }
    for (int i = 0; i < BT_PREDICT_TILE; ++i) {
        REAL lane[BT_PREDICT_GROUP];
        memcpy(lane, total[i], sizeof lane);
        sums[2 * i] = NAME(join)(lane);
    }
}

static inline __attribute__((always_inline)) void NAME(points)(const bt_predict_set* set, int dims,
                                                               const REAL* x, int n, REAL* sums) {
    const REAL* positive = set->block;
    const REAL* negative = positive + set->group_count[0] * (dims + 1) * BT_PREDICT_GROUP;
    for (int i = 0; i < n; i += BT_PREDICT_TILE) {
        NAME(tile)(positive, set->group_count[0], dims, x + i * dims, sums + 2 * i);
        NAME(tile)(negative, set->group_count[1], dims, x + i * dims, sums + 2 * i + 1);
    }
}

/// Small dimensions get a loop of their own, so that a point's coordinates stay in registers.
void NAME(KERNEL)(const bt_predict_set* set, const REAL* x, int n, REAL* sums) {
    switch (set->dims) {
    case 1:
        NAME(points)(set, 1, x, n, sums);
        break;
    case 2:
        NAME(points)(set, 2, x, n, sums);
        break;
    case 3:
        NAME(points)(set, 3, x, n, sums);
        break;
    case 4:
        NAME(points)(set, 4, x, n, sums);
        break;
    case 5:
        NAME(points)(set, 5, x, n, sums);
        break;
    case 6:
        NAME(points)(set, 6, x, n, sums);
        break;
    default:
        NAME(points)(set, set->dims, x, n, sums);
    }
}

#undef LANES
#undef PARTS
