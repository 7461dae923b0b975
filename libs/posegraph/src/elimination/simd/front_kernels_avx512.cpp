#define KERNELS_NAME "avx512"
#define KERNELS_TABLE kFrontKernelsAvx512
#define KERNELS_WIDTH 8
#define KERNELS_VECTORS 2
#include "front_kernels_impl.h"
