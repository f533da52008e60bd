// carom/contact.cpp: what carom_contact.h declares.
//
// SPDX-License-Identifier: BSD-3-Clause
#include "../carom_contact.h"

#include <type_traits>

#include "contact.hpp"

namespace {

/// Call `work` with a contact of this kind; false if there is none.
template <class Work> bool with_kind(int springs, unsigned parts, Work work) {
    using namespace carom;
    const auto of_parts = [&](auto count) {
        constexpr int n = decltype(count)::value;
        switch (parts) {
            case elastic: return work(static_cast<Contact<n, double, elastic>*>(nullptr)), true;
            case viscous: return work(static_cast<Contact<n, double, viscous>*>(nullptr)), true;
            case ledger: return work(static_cast<Contact<n, double, ledger>*>(nullptr)), true;
            case viscous | ledger:
                return work(static_cast<Contact<n, double, viscous | ledger>*>(nullptr)), true;
            default: return false;
        }
    };
    switch (springs) {
        case 16: return of_parts(std::integral_constant<int, 16>{});
        case 32: return of_parts(std::integral_constant<int, 32>{});
        case 64: return of_parts(std::integral_constant<int, 64>{});
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
