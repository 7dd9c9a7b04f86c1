/// The inner loop of the surrogate's predictor: sums of radial basis functions over all support
/// vectors. One source (predict_kernel.c), built once per instruction-set level; predictor.c
/// chooses. All levels add in the same order: sixteen running sums, joined by a fixed tree.
#ifndef BT_SURROGATE_PREDICT_KERNEL_H
#define BT_SURROGATE_PREDICT_KERNEL_H

enum {
    BT_PREDICT_GROUP = 16, ///< support vectors are stored and summed in groups of this many
    BT_PREDICT_TILE = 4,   ///< points are taken this many at a time
};

/// Support vectors of the two signs of their coefficients, each padded to whole groups with
/// coefficient 0. A group is [(dims + 1) * 16] numbers: coordinate 0 of its vectors, coordinate 1,
/// ..., absolute coefficient.
typedef struct bt_predict_set {
    int dims;
    int group_count[2]; ///< positive, negative coefficients
    const void* block;  ///< float or double, 64-byte aligned
} bt_predict_set;

/// sums[2 i + sign] = sum over the vectors s of that sign of |coef| 2^-(|x_i - s|^2).
///
/// @param x     [n * dims] points in the coordinates of the set
/// @param n     a multiple of BT_PREDICT_TILE
typedef void bt_predict_float(const bt_predict_set* set, const float* x, int n, float* sums);
typedef void bt_predict_double(const bt_predict_set* set, const double* x, int n, double* sums);

bt_predict_float bt_predict_float_v1, bt_predict_float_v3, bt_predict_float_v4;
bt_predict_double bt_predict_double_v1, bt_predict_double_v3, bt_predict_double_v4;

#endif
