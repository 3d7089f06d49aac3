/* The edge computation of src/subslide/kernels/edge/two_layers.py (with waves.py and viscosity/) as a C programmer
   would write it for speed: one vector loop over n edges, IFCPH alone, every choice a conditional expression.
   Compiled with -DREAL=double or -DREAL=float; see reference.py for the flags. Scaled, g = 1. */
#include <tgmath.h>

static inline REAL least(REAL x, REAL y) { return x < y ? x : y; }
static inline REAL most(REAL x, REAL y) { return x > y ? x : y; }

/* One Newton step on ((x - u1)^2 - h1) ((x - u2)^2 - h2) - k; stays where the slope or k is zero. */
static inline REAL newton(REAL x, REAL u1, REAL h1, REAL u2, REAL h2, REAL k)
{
    REAL d1 = x - u1, d2 = x - u2;
    REAL a = d1 * d1 - h1, b = d2 * d2 - h2;
    REAL slope = d1 * b + d2 * a;
    int moves = (slope != 0) & (k != 0);
    REAL step = (a * b - k) / (moves ? slope + slope : (REAL)1);
    return moves ? x - step : x;
}

static inline REAL roe_velocity(REAL root_i, REAL u_i, REAL root_j, REAL u_j)
{
    REAL weight = root_i + root_j;
    return (root_i * u_i + root_j * u_j) / (weight > 0 ? weight : (REAL)1);
}

/* HLL: the line through (s_l, |s_l|) and (s_r, |s_r|). */
static inline void hll(REAL s_l, REAL s_r, REAL *a0, REAL *a1)
{
    REAL width = s_r - s_l;
    REAL scale = 1 / (width > 0 ? width : (REAL)1);
    *a0 = (s_r * fabs(s_l) - s_l * fabs(s_r)) * scale;
    *a1 = (fabs(s_r) - fabs(s_l)) * scale;
}

/* in: h1 u1 h2 u2 at i, the same at j, lower and upper bound of the speeds in both cells, jump of h1 + h2, stuck (0 or
   1). out: f1 m1 p1 f2 m2 p2. Each an array of n. exact_front: grains run onto a dry bed with the flux of a dam break. */
void edge_fluxes(long n, REAL r, REAL dry_depth, int exact_front, const REAL *const *in, REAL *const *out)
{
    const REAL *restrict h1_in = in[0], *restrict u1_in = in[1], *restrict h2_in = in[2], *restrict u2_in = in[3];
    const REAL *restrict h1_jn = in[4], *restrict u1_jn = in[5], *restrict h2_jn = in[6], *restrict u2_jn = in[7];
    const REAL *restrict slowest = in[8], *restrict fastest = in[9], *restrict jump = in[10], *restrict held = in[11];
    REAL *restrict f1 = out[0], *restrict m1 = out[1], *restrict p1 = out[2];
    REAL *restrict f2 = out[3], *restrict m2 = out[4], *restrict p2 = out[5];
    const REAL half = (REAL)0.5, one = 1, zero = 0;
    const REAL stretch = sqrt(one + sqrt(r)), root_reduced = sqrt(one - r), third = one / 3;

#pragma omp simd
    for (long e = 0; e < n; e++) {
        REAL h1_i = h1_in[e], u1_i = u1_in[e], h2_i = h2_in[e], u2_i = u2_in[e];
        REAL h1_j = h1_jn[e], u1_j = u1_jn[e], h2_j = h2_jn[e], u2_j = u2_jn[e];
        REAL d_eta = jump[e];
        int stuck = held[e] != 0;

        /* Roe means */
        REAL h1 = half * (h1_i + h1_j), h2 = half * (h2_i + h2_j);
        REAL root1_i = sqrt(h1_i), root1_j = sqrt(h1_j);
        REAL root2_i = sqrt(h2_i), root2_j = sqrt(h2_j);
        REAL u1 = roe_velocity(root1_i, u1_i, root1_j, u1_j);
        REAL u2 = roe_velocity(root2_i, u2_i, root2_j, u2_j);
        REAL gap1 = u1_j - u1_i - (root1_i + root1_j);
        REAL gap2 = u2_j - u2_i - root_reduced * (root2_i + root2_j);
        REAL q1_i = h1_i * u1_i, q1_j = h1_j * u1_j, q2_i = h2_i * u2_i, q2_j = h2_j * u2_j;
        REAL d_h2 = h2_j - h2_i, d_h1 = d_eta - d_h2, d_q1 = q1_j - q1_i, d_q2 = q2_j - q2_i;

        /* outer speeds: the same start, limits and three steps as waves.py */
        REAL k = r * h1 * h2;
        REAL spread = sqrt((h1 - h2) * (h1 - h2) + 4 * k);
        REAL c = sqrt(half * (h1 + h2 + spread));
        REAL w1 = half + half * (h1 - h2) / (spread > 0 ? spread : one);
        REAL mean = w1 * u1 + (one - w1) * u2;
        REAL c1 = sqrt(h1), c2 = sqrt(h2);
        REAL fast = most(mean + c, most(u1 + c1, u2 + c2));
        REAL slow = least(mean - c, least(u1 - c1, u2 - c2));
        fast = least(newton(fast, u1, h1, u2, h2, k), most(u1 + stretch * c1, u2 + stretch * c2));
        slow = most(newton(slow, u1, h1, u2, h2, k), least(u1 - stretch * c1, u2 - stretch * c2));
        fast = newton(newton(fast, u1, h1, u2, h2, k), u1, h1, u2, h2, k);
        slow = newton(newton(slow, u1, h1, u2, h2, k), u1, h1, u2, h2, k);

        /* inner pair from the quartic's coefficients; S_L, S_R, S_int */
        REAL centre = u1 + u2 - half * (slow + fast);
        REAL pairs = u1 * u1 - h1 + u2 * u2 - h2 + 4 * u1 * u2;
        REAL product = pairs - slow * fast - 2 * centre * (slow + fast);
        REAL s_l = least(slow, slowest[e]), s_r = most(fast, fastest[e]);
        REAL size = fabs(centre) + sqrt(most(centre * centre - product, zero));
        int right = fabs(s_r) > fabs(s_l);
        REAL near = right ? s_r : s_l, far = right ? s_l : s_r;
        REAL s_int = copysign(size, near);

        /* IFCP, or HLL where a layer is dry, or parts faster than it can fill the gap */
        REAL sign = right ? one : -one;
        REAL denominator = (far - s_int) * (far - near);
        REAL i2 = -sign * (far + far) / (denominator != 0 ? denominator : one);
        REAL i0 = i2 * s_int * near;
        REAL i1 = s_r == -s_l ? zero : sign - i2 * (near + s_int);
        int one_sided = s_r <= 0 || s_l >= 0;
        i0 = one_sided ? zero : i0;
        i1 = one_sided ? (s_l >= 0 ? one : -one) : i1;
        i2 = one_sided ? zero : i2;
        REAL d0, d1;
        hll(s_l, s_r, &d0, &d1);
        int dry = (most(gap1, gap2) > 0) | (least(least(h1_i, h1_j), least(h2_i, h2_j)) <= dry_depth);
        REAL a0 = dry ? d0 : i0;
        REAL a1 = dry ? d1 : i1;
        REAL a2 = dry ? zero : i2;

        /* viscosity: two products with the Roe matrix */
        REAL e1 = stuck ? d_eta : d_h1, e3 = stuck ? zero : d_h2;
        REAL k1 = h1 - u1 * u1, k2 = h2 - u2 * u2;
        REAL b2 = k1 * e1 + 2 * u1 * d_q1 + h1 * e3;
        REAL b4 = r * h2 * e1 + k2 * e3 + 2 * u2 * d_q2;
        REAL g2 = k1 * d_q1 + 2 * u1 * b2 + h1 * d_q2;
        REAL g4 = r * h2 * d_q1 + k2 * d_q2 + 2 * u2 * b4;

        /* grains that run onto a dry bed: the fan of a dam break */
        int outward = h2_i > h2_j;
        REAL h_wet = outward ? h2_i : h2_j, w = outward ? u2_i : -u2_j;
        REAL c_wet = root_reduced * (outward ? root2_i : root2_j);
        REAL u_fan = most(zero, third * (w + c_wet + c_wet));
        REAL u_star = w < c_wet ? u_fan : w;
        REAL h_star = w < c_wet ? u_fan * u_fan / (one - r) : h_wet;
        REAL mass = h_star * u_star;
        REAL push = half * (one - r) * (h_star * h_star - half * h_wet * h_wet);
        int front = exact_front && !stuck && h2_i != h2_j && least(h2_i, h2_j) <= dry_depth;

        REAL through = half * (q2_i + q2_j - (a0 * e3 + a1 * d_q2 + a2 * b4));
        REAL carried = half * (q2_i * u2_i + q2_j * u2_j - (a0 * d_q2 + a1 * b4 + a2 * g4));
        through = front ? (outward ? mass : -mass) : through;
        through = stuck ? zero : through;
        REAL both = a0 * (e1 + e3) + a1 * (d_q1 + d_q2);
        REAL viscous = front ? both - (q2_i + q2_j - 2 * through) : a0 * e1 + a1 * d_q1 + a2 * b2;
        f1[e] = half * (q1_i + q1_j - viscous);
        m1[e] = half * (q1_i * u1_i + q1_j * u1_j - (a0 * d_q1 + a1 * b2 + a2 * g2));
        f2[e] = through;
        /* no momentum of the grains passes a stuck edge: the halves of the pressure act on each side by its weight */
        REAL d_head = r * d_h1 + d_h2;
        carried = front ? mass * u_star + push : carried;
        m2[e] = stuck ? (REAL)0.25 * (h2_i - h2_j) * d_head : carried;
        p1[e] = h1 * d_eta;
        p2[e] = h2 * d_head;
    }
}
