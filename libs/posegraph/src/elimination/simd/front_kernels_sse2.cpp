#define KERNELS_NAME "sse2"
#define KERNELS_TABLE kFrontKernelsSse2
#define KERNELS_WIDTH 2
#define KERNELS_VECTORS 2
#include "front_kernels_impl.h"
