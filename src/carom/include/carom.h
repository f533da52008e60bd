/* carom.h: the oblique impact of elastic spheres, for C and every language that can call it.
 *
 * psi = 2 chi V_x/(mu V_z) in the notation of the manual: psi_1 is the dimensionless tangential
 * velocity of the contact point before the impact, psi_2 after it; chi is the ratio that tells how
 * tangential and normal motion are tuned to each other (1.44 for a solid steel ball on steel).
 *
 * All functions can be called from several threads at once; nothing is kept between calls. They
 * return 0, or -1 if there is no memory; what became of each impact stands in `status`.
 *
 *     cc example.c -I$(python -c "import carom; print(carom.get_include())") \
 *                  $(python -c "import carom; print(carom.get_library())") -lm
 */

#ifndef CAROM_H
#define CAROM_H

#include <stddef.h>
#include <stdint.h>

#ifndef CAROM_API
#if defined(_WIN32)
#define CAROM_API __declspec(dllimport)
#else
#define CAROM_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

enum carom_status {
    CAROM_SOLVED = 0,
    CAROM_PSI_NOT_FINITE = 1,
    CAROM_CHI_NOT_POSITIVE = 2,
    CAROM_TOO_MANY_PHASES = 3,
    CAROM_UNRESOLVED = 4,
    CAROM_PLATE_GIVES_WAY = 5
};

/* psi_2 of n impacts without losses; NaN where the status is not 0. */
CAROM_API int carom_rebound(
    size_t n, const double *psi, const double *chi, double *psi_out, int8_t *status);

/* The same on plates that give way by lambda = m_n V_1/(8 sqrt(D rho h) d_max), from 0 to 2. */
CAROM_API int carom_rebound_on_plate(
    size_t n, const double *psi, const double *chi, const double *lambda,
    double *psi_out, int8_t *status);

/* Normal restitution on such plates, which depends on neither psi nor chi, and the duration of the
 * contact in units of d_max/V_1, of the penetration d_max into a thick wall; NaN where lambda lies
 * outside 0 to 2. */
CAROM_API int carom_motion_on_plate(
    size_t n, const double *lambda, double *restitution, double *duration);

/* psi_2 and normal restitution of n impacts of Kelvin-Voigt solids, viscous in compression and in
 * shear alike; alpha = tau V_1/d_max, with the retardation time tau, the normal speed V_1 and the
 * penetration d_max that it would reach without losses. */
CAROM_API int carom_rebound_viscous(
    size_t n, const double *psi, const double *chi, const double *alpha,
    double *psi_out, double *restitution, int8_t *status);

/* The level of x86-64 (1 to 4) whose machine code this processor runs; 0 for other processors. */
CAROM_API int carom_processor_level(void);

/* A status in words. */
CAROM_API const char *carom_status_message(int status);

#ifdef __cplusplus
}
#endif

#endif
