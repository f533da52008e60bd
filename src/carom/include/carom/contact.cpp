// carom/contact.cpp: what carom_contact.h declares.
//
// SPDX-License-Identifier: BSD-3-Clause
#include "../carom_contact.h"

#include <type_traits>

#include "contact.hpp"

namespace {

template <int N, class Real, class Work> bool of_parts(unsigned parts, Work work) {
    using namespace carom;
    switch (parts) {
        case elastic: return work(static_cast<Contact<N, Real, elastic>*>(nullptr)), true;
        case viscous: return work(static_cast<Contact<N, Real, viscous>*>(nullptr)), true;
        case ledger: return work(static_cast<Contact<N, Real, ledger>*>(nullptr)), true;
        case viscous | ledger:
            return work(static_cast<Contact<N, Real, viscous | ledger>*>(nullptr)), true;
        default: return false;
    }
}

template <int N, class Work> bool of_precision(unsigned parts, Work work) {
    if ((parts & CAROM_SINGLE) != 0) return of_parts<N, float>(parts - CAROM_SINGLE, work);
    return of_parts<N, double>(parts, work);
}

/// Call `work` with a contact of this kind; false if there is none.
template <class Work> bool with_kind(int springs, unsigned parts, Work work) {
    switch (springs) {
        case 16: return of_precision<16>(parts, work);
        case 32: return of_precision<32>(parts, work);
        case 64: return of_precision<64>(parts, work);
        default: return false;
    }
}

}  // namespace

size_t carom_contact_size(int springs, unsigned parts) {
    size_t size = 0;
    with_kind(springs, parts, [&](auto* kind) { size = sizeof(*kind); });
    return size;
}

int carom_contact_advance(void* contact, int springs, unsigned parts, const carom_pair* pair,
                          const carom_motion* motion, carom_load* load) {
    int status = CAROM_BAD_KIND;
    with_kind(springs, parts, [&](auto* kind) {
        using Kind = std::remove_pointer_t<decltype(kind)>;
        const carom::Pair bodies{pair->modulus, pair->radius, pair->stiffness_ratio, pair->friction,
                                 pair->mass, pair->retardation, pair->viscous_shear != 0};
        const carom::Motion now{motion->penetration, motion->approach, motion->slide_x,
                                motion->slide_y, motion->step};
        carom::Load found{};
        status = static_cast<int>(carom::advance(*static_cast<Kind*>(contact), bodies, now, found));
        if (status == CAROM_CONTACT_OK)
            *load = {found.normal, found.x, found.y, found.friction, found.viscosity};
    });
    return status;
}

const char* carom_contact_message(int status) {
    if (status == CAROM_BAD_KIND) return "springs must be 16, 32 or 64, parts a sum of carom_parts";
    return carom::message(static_cast<carom::Status>(status));
}
