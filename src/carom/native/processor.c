/* Which level of x86-64 this processor and its system have, 1 to 4, or 0 for other processors: asked of the
   processor itself, as not all compilers bring a working __builtin_cpu_supports. */

#include "export.h"

#if defined(__x86_64__) || defined(_M_X64)
#include <cpuid.h>

#define BIT(n) (1u << (n))

/* leaf 1, ecx: sse3 ssse3 cx16 sse4.1 sse4.2 popcnt; fma movbe osxsave avx f16c */
#define SECOND (BIT(0) | BIT(9) | BIT(13) | BIT(19) | BIT(20) | BIT(23))
#define THIRD (BIT(12) | BIT(22) | BIT(27) | BIT(28) | BIT(29))
/* leaf 0x80000001, ecx: lahf; lzcnt */
#define SECOND_MORE BIT(0)
#define THIRD_MORE BIT(5)
/* leaf 7, ebx: bmi1 avx2 bmi2; avx512 f dq cd bw vl */
#define THIRD_NEWER (BIT(3) | BIT(5) | BIT(8))
#define FOURTH_NEWER (BIT(16) | BIT(17) | BIT(28) | BIT(30) | BIT(31))
/* registers that the system keeps: xmm ymm; masks and zmm */
#define THIRD_KEPT 0x06u
#define FOURTH_KEPT 0xe6u

static int all(unsigned bits, unsigned wanted) { return (bits & wanted) == wanted; }

CAROM_API int carom_processor_level(void)
{
    unsigned a, b, c = 0, d, more = 0, newer = 0, kept;
    __get_cpuid(1, &a, &b, &c, &d);
    __get_cpuid(0x80000001u, &a, &b, &more, &d);
    __get_cpuid_count(7, 0, &a, &newer, &b, &d);
    if (!(all(c, SECOND) && all(more, SECOND_MORE))) return 1;
    if (!(all(c, THIRD) && all(more, THIRD_MORE) && all(newer, THIRD_NEWER))) return 2;
    __asm__ volatile("xgetbv" : "=a"(kept), "=d"(d) : "c"(0));
    if (!all(kept, THIRD_KEPT)) return 2;
    return all(newer, FOURTH_NEWER) && all(kept, FOURTH_KEPT) ? 4 : 3;
}
#else
CAROM_API int carom_processor_level(void) { return 0; }
#endif
