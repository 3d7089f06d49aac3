/* What one core can do at most: bandwidth of memory, and rates of multiply-adds, divisions and square roots.
   Compiled with -DREAL=double or -DREAL=float; see machine.py. */

#if defined(__AVX512F__)
#define BYTES 64
#elif defined(__AVX__)
#define BYTES 32
#else
#define BYTES 16
#endif
#define LANES (BYTES / (int)sizeof(REAL))
#define CHAINS 12 /* independent chains of operations, more than a unit's latency times its width */

typedef REAL vector __attribute__((vector_size(BYTES)));

/* a = b + s c on n numbers: two reads, one write, and the read of a line before it is written. */
void triad(long n, REAL s, REAL *restrict a, const REAL *restrict b, const REAL *restrict c)
{
#pragma omp simd
    for (long i = 0; i < n; i++)
        a[i] = b[i] + s * c[i];
}

static REAL sum(const vector *x)
{
    REAL total = 0;
    for (int k = 0; k < CHAINS; k++)
        for (int lane = 0; lane < LANES; lane++)
            total += x[k][lane];
    return total;
}

/* Each of the three does n times CHAINS * LANES operations, and returns their sum so that none is left out. */
REAL multiply_adds(long n, REAL factor, REAL term)
{
    vector x[CHAINS];
    for (int k = 0; k < CHAINS; k++)
        x[k] = (vector){0} + term;
    for (long i = 0; i < n; i++)
#pragma GCC unroll 16
        for (int k = 0; k < CHAINS; k++)
            x[k] = x[k] * factor + term;
    return sum(x);
}

REAL divisions(long n, REAL factor, REAL term)
{
    vector x[CHAINS];
    for (int k = 0; k < CHAINS; k++)
        x[k] = (vector){0} + term;
    for (long i = 0; i < n; i++)
#pragma GCC unroll 16
        for (int k = 0; k < CHAINS; k++)
            x[k] = factor / x[k];
    return sum(x);
}

REAL square_roots(long n, REAL factor, REAL term)
{
    vector x[CHAINS];
    for (int k = 0; k < CHAINS; k++)
        x[k] = (vector){0} + term;
    (void)factor;
    for (long i = 0; i < n; i++)
#pragma GCC unroll 16
        for (int k = 0; k < CHAINS; k++)
            for (int lane = 0; lane < LANES; lane++)
                x[k][lane] = sizeof(REAL) == 8 ? (REAL)__builtin_sqrt(x[k][lane]) : (REAL)__builtin_sqrtf(x[k][lane]);
    return sum(x);
}

int operations_each(void) { return CHAINS * LANES; }
