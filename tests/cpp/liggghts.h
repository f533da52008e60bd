// What the tangential model for LIGGGHTS uses of it, and no more: a stand-in for its headers.
#ifndef LIGGGHTS_STAND_IN_H
#define LIGGGHTS_STAND_IN_H

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#define FLERR __FILE__, __LINE__

namespace LAMMPS_NS {

struct Error {
    void all(const char *, int, const char *what) { throw std::runtime_error(what); }
    void one(const char *, int, const char *what) { throw std::runtime_error(what); }
    void warning(const char *, int, const char *what, int = 1) { said.emplace_back(what); }
    std::vector<std::string> said;
};
struct Update { double dt; };
struct Neighbor { int oneatom, pgsize; };
struct LAMMPS {
    Error error;
    Update update;
    Neighbor neighbor;
};
struct Pointers {
    Error *error;
    Update *update;
    Neighbor *neighbor;
    explicit Pointers(LAMMPS *all)
        : error(&all->error), update(&all->update), neighbor(&all->neighbor) {}
};

}  // namespace LAMMPS_NS

using namespace LAMMPS_NS;

namespace MODEL_PARAMS {
inline void createYeff() {}
inline void createGeff() {}
inline void createCoeffFrict() {}
}  // namespace MODEL_PARAMS

struct Settings {
    double given;
    bool on;
    void registerDoubleSetting(const std::string &, double &value, double) { value = given; }
    void registerOnOff(const std::string &, bool &value, bool) { value = on; }
};

struct PropertyRegistry {
    double *tables[3];  // Yeff, Geff, coeffFrict of type 0
    void registerProperty(const char *, void (*)()) {}
    void connect(const std::string &name, double **&table, const char *) {
        table = &tables[name == "Yeff" ? 0 : name == "Geff" ? 1 : 2];
    }
};

namespace LIGGGHTS {

struct IContactHistorySetup {
    std::vector<bool> changes_sign;
    int add_history_value(const std::string &, const std::string &flag) {
        changes_sign.push_back(flag == "1");
        return static_cast<int>(changes_sign.size()) - 1;
    }
};

namespace ContactModels {

constexpr int CONTACT_TANGENTIAL_MODEL = 4, TANGENTIAL_CAROM = 20;

struct SurfacesCloseData {
    int *contact_flags = nullptr;
    double *contact_history = nullptr;
    double radi, radj, area_ratio = 1.0;
    int itype = 0, jtype = 0, computeflag = 1, shearupdate = 1;
    bool is_wall = false;
    double *omega_i, *omega_j;
};
struct SurfacesIntersectData : SurfacesCloseData {
    double en[3], vn, kn, deltan, cri, crj, vtr1, vtr2, vtr3, meff;
};
struct ForceData {
    double delta_F[3] = {0, 0, 0}, delta_torque[3] = {0, 0, 0};
};
class ContactModelBase {};

struct TangentialModelBase : Pointers {
    TangentialModelBase(LAMMPS *all, IContactHistorySetup *, ContactModelBase *) : Pointers(all) {}
    virtual ~TangentialModelBase() = default;
    virtual void registerSettings(Settings &) = 0;
    virtual void postSettings(IContactHistorySetup *, ContactModelBase *) = 0;
    virtual void connectToProperties(PropertyRegistry &) = 0;
    virtual void surfacesIntersect(const SurfacesIntersectData &, ForceData &, ForceData &) = 0;
    virtual void surfacesClose(SurfacesCloseData &, ForceData &, ForceData &) = 0;
    virtual void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) = 0;
    virtual void endPass(SurfacesIntersectData &, ForceData &, ForceData &) = 0;
};
template <int> class TangentialModel;

}  // namespace ContactModels
}  // namespace LIGGGHTS

#endif
