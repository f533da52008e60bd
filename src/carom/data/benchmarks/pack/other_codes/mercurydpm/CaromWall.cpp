// The set `wall` in MercuryDPM 1.0, NOT RUN BY CAROM: see ../README.md.
// Reads ../../wall/results.csv and leaves results.csv beside it.
// x is the tangential direction and z the normal; positive spin is a negative turn about y.

#include <cmath>
#include <fstream>
#include <iomanip>
#include <sstream>
#include <string>

#include "Mercury3D.h"
#include "Species/HertzianViscoelasticMindlinSpecies.h"
#include "Walls/InfiniteWall.h"

const Mdouble radius = 0.005, density = 7850.0;         // m, kg/m^3
const Mdouble young = 210e9, poisson = 0.3;             // Pa; both bodies
const Mdouble friction = 0.2;
const Mdouble duration = 5.47663159291e-05;             // s, of Hertz's contact

class Impact : public Mercury3D
{
public:
    Impact(Mdouble normal, Mdouble tangential, Mdouble spin)
    {
        setName("CaromWall");
        setDomain(Vec3D(-1.0, -1.0, 0.0) * 4.0 * radius, Vec3D(1.0, 1.0, 1.0) * 4.0 * radius);
        setGravity(Vec3D(0.0, 0.0, 0.0));
        setFileType(FileType::NO_FILE);

        HertzianViscoelasticMindlinSpecies species;
        const Mdouble shear = young / (2.0 * (1.0 + poisson));
        species.setDensity(density);
        species.setEffectiveElasticModulus(young / (2.0 * (1.0 - poisson * poisson)));
        species.setEffectiveShearModulus(shear / (2.0 * (2.0 - poisson)));
        species.setDissipation(0.0);
        species.setSlidingDissipation(0.0);
        species.setSlidingFrictionCoefficient(friction);
        auto stored = speciesHandler.copyAndAddObject(species);

        SphericalParticle sphere;
        sphere.setSpecies(stored);
        sphere.setRadius(radius);
        sphere.setPosition(Vec3D(0.0, 0.0, radius * (1.0 + 1e-9)));
        sphere.setVelocity(Vec3D(tangential, 0.0, -normal));
        sphere.setAngularVelocity(Vec3D(0.0, -spin, 0.0));
        particleHandler.copyAndAddObject(sphere);

        InfiniteWall wall;
        wall.setSpecies(stored);
        wall.set(Vec3D(0.0, 0.0, -1.0), Vec3D(0.0, 0.0, 0.0));
        wallHandler.copyAndAddObject(wall);

        setTimeStep(duration / 2000.0);
        setTimeMax(1.2 * duration);
    }
};

int main()
{
    std::ifstream inputs("../../wall/results.csv");
    std::ofstream results("results.csv");
    std::string line, cell;
    std::getline(inputs, line);
    results << line << "\n" << std::setprecision(17);
    while (std::getline(inputs, line))
    {
        std::stringstream cells(line);
        Mdouble before[3];
        for (Mdouble& value : before)
        {
            std::getline(cells, cell, ',');
            value = std::stod(cell);
        }
        Impact impact(before[0], before[1], before[2]);
        impact.solve();
        const auto sphere = impact.particleHandler.getLastObject();
        results << before[0] << ',' << before[1] << ',' << before[2] << ','
                << sphere->getVelocity().Z << ',' << sphere->getVelocity().X << ','
                << -sphere->getAngularVelocity().Y << "\n";
    }
    return 0;
}
