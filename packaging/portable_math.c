// SPDX-License-Identifier: Apache-2.0
// The functions that glibc before 2.35 rounds otherwise in the last digit, as a newer glibc has them: a flight is the
// same bits wherever the portable program runs. packaging/portable_root.sh links this with objects of a newer
// libm.a into one, in which all other names stay inside. What libm.a chooses at loading is chosen here, by the same
// rule: nothing of it may run before the program does.
typedef double Real;

Real __tan_fma(Real), __tan_sse2(Real);
Real __atan_fma(Real), __atan_sse2(Real);
Real __ieee754_atan2_fma(Real, Real), __ieee754_atan2_sse2(Real, Real);
Real __ieee754_asin_fma(Real), __ieee754_asin_sse2(Real);
Real __ieee754_acos_fma(Real), __ieee754_acos_sse2(Real);
Real __log1p_fma(Real), __log1p_sse2(Real);
Real __expm1_fma(Real), __expm1_sse2(Real);
Real __log2_fma(Real), __log2_sse2(Real);
void __sincos_fma(Real, Real*, Real*), __sincos_sse2(Real, Real*, Real*);
Real __ieee754_atanh(Real);
Real __ieee754_hypot(Real, Real);
Real __tanh(Real);

// What the objects refer to: nobody here reads errno, and their own choice is never made.
__thread int errno;
char _dl_x86_cpu_features[4096];

static int fma_is_here(void) { return __builtin_cpu_supports("fma") && __builtin_cpu_supports("avx2"); }

Real tan(Real x) { return fma_is_here() ? __tan_fma(x) : __tan_sse2(x); }
Real atan(Real x) { return fma_is_here() ? __atan_fma(x) : __atan_sse2(x); }
Real atan2(Real y, Real x) { return fma_is_here() ? __ieee754_atan2_fma(y, x) : __ieee754_atan2_sse2(y, x); }
Real asin(Real x) { return fma_is_here() ? __ieee754_asin_fma(x) : __ieee754_asin_sse2(x); }
Real acos(Real x) { return fma_is_here() ? __ieee754_acos_fma(x) : __ieee754_acos_sse2(x); }
Real log1p(Real x) { return fma_is_here() ? __log1p_fma(x) : __log1p_sse2(x); }
Real expm1(Real x) { return fma_is_here() ? __expm1_fma(x) : __expm1_sse2(x); }
Real log2(Real x) { return fma_is_here() ? __log2_fma(x) : __log2_sse2(x); }
void sincos(Real x, Real* sine, Real* cosine) { (fma_is_here() ? __sincos_fma : __sincos_sse2)(x, sine, cosine); }
Real atanh(Real x) { return __ieee754_atanh(x); }
Real hypot(Real x, Real y) { return __ieee754_hypot(x, y); }
Real tanh(Real x) { return __tanh(x); }
