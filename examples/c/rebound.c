/* psi_2 of some impacts on the exact law, computed by Carom's C library. */

#include <stdio.h>

#include "carom.h"

int main(void)
{
    const double psi[] = {0.5, 1.0, 2.0, 6.0}, chi[] = {1.44, 1.44, 1.44, 1.44};
    double psi_out[4];
    int8_t status[4];
    if (carom_rebound(4, psi, chi, psi_out, status)) return 1;
    for (int i = 0; i < 4; i++)
        printf("%g %.12f %s\n", psi[i], psi_out[i], carom_status_message(status[i]));
    return 0;
}
