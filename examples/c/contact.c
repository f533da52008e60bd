/* One oblique impact with the exact contact law, stepped as a DEM code does it (velocity Verlet).
 *
 *     INCLUDE=$(python -c "import carom; print(carom.get_include())")
 *     FAST="-O3 -march=native -fno-math-errno"
 *     c++ -std=c++17 $FAST -c $INCLUDE/carom/contact.cpp -o carom_contact.o
 *     cc -std=c99 contact.c carom_contact.o -I$INCLUDE -lm -o contact && ./contact
 *
 * A steel ball strikes a steel plate at 20 degrees, friction 0.2. Optional: steps per contact.
 */
#include <carom_contact.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SPRINGS = 64 };

int main(int count, char **words)
{
    const double steps = count > 1 ? atof(words[1]) : 100.0, pi = 3.14159265358979;
    const double young = 210e9, poisson = 0.3, density = 7850.0, radius = 5e-3;
    const double mass = 4.0 / 3.0 * pi * radius * radius * radius * density;
    const double angle = 20.0 * pi / 180.0, speed = 0.6, normal = speed * cos(angle);
    const struct carom_pair pair = {
        0.5 * young / (1.0 - poisson * poisson), radius, 2.0 * (1.0 - poisson) / (2.0 - poisson),
        0.2, mass, 0.0, 1};
    const double deepest =
        pow(15.0 * mass * normal * normal / (16.0 * pair.modulus * sqrt(radius)), 0.4);
    struct carom_motion motion = {0.0, normal, speed * sin(angle), 0.0,
                                  2.943275 * deepest / normal / steps};
    struct carom_load load = {0.0, 0.0, 0.0, 0.0, 0.0};
    void *contact = calloc(1, carom_contact_size(SPRINGS, CAROM_ELASTIC));
    double slid = 0.0; /* of the centre, per mass: (2/7) m is what the contact point feels */

    do { /* the contact point has 2/7 of the mass of a solid ball */
        motion.approach -= 0.5 * motion.step * load.normal / mass;
        motion.slide_x -= 0.5 * motion.step * load.x / (2.0 / 7.0 * mass);
        slid += 0.5 * motion.step * load.x / mass;
        motion.penetration += motion.step * motion.approach;
        const int status =
            carom_contact_advance(contact, SPRINGS, CAROM_ELASTIC, &pair, &motion, &load);
        if (status) {
            fprintf(stderr, "%s\n", carom_contact_message(status));
            return 1;
        }
        motion.approach -= 0.5 * motion.step * load.normal / mass;
        motion.slide_x -= 0.5 * motion.step * load.x / (2.0 / 7.0 * mass);
        slid += 0.5 * motion.step * load.x / mass;
    } while (motion.penetration > 0.0);
    free(contact);

    const double after = speed * sin(angle) - slid;
    printf("leaves at %.4f deg with %.4f rad/s\n", atan2(after, -motion.approach) * 180.0 / pi,
           (motion.slide_x - after) / radius);
    return 0;
}
