// carom/contact.cpp: what carom_contact.h declares.
//
// SPDX-License-Identifier: BSD-3-Clause
#include "../carom_contact.h"

#include "contact.hpp"

#include "own_names.h"

#include <type_traits>

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

int carom_contact_advance_many(void* contacts, int springs, unsigned parts, const carom_pair* pair,
                               const carom_motion* motions, carom_load* loads, size_t count) {
    int first = CAROM_CONTACT_OK;
    const bool is_offered = with_kind(springs, parts, [&](auto* kind) {
        using Kind = std::remove_pointer_t<decltype(kind)>;
        const carom::Pair bodies{pair->modulus, pair->radius, pair->stiffness_ratio, pair->friction,
                                 pair->mass, pair->retardation, pair->viscous_shear != 0};
        for (size_t k = 0; k < count; ++k) {
            const carom_motion& motion = motions[k];
            const carom::Motion now{motion.penetration, motion.approach, motion.slide_x,
                                    motion.slide_y, motion.step};
            carom::Load load{};
            const auto status = carom::advance(static_cast<Kind*>(contacts)[k], bodies, now, load);
            if (status == carom::Status::ok)
                loads[k] = {load.normal, load.x, load.y, load.friction, load.viscosity};
            else if (first == CAROM_CONTACT_OK)
                first = static_cast<int>(status);
        }
    });
    return is_offered ? first : CAROM_BAD_KIND;
}

int carom_contact_advance(void* contact, int springs, unsigned parts, const carom_pair* pair,
                          const carom_motion* motion, carom_load* load) {
    return carom_contact_advance_many(contact, springs, parts, pair, motion, load, 1);
}

const char* carom_contact_message(int status) {
    if (status == CAROM_BAD_KIND) return "springs must be 16, 32 or 64, parts a sum of carom_parts";
    return carom::message(static_cast<carom::Status>(status));
}

#include "own_names.h"
