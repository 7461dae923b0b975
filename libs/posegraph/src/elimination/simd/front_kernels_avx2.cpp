#define KERNELS_NAME "avx2"
#define KERNELS_TABLE kFrontKernelsAvx2
#define KERNELS_WIDTH 4
#define KERNELS_VECTORS 2
#include "front_kernels_impl.h"
