// Lent: an object that Frond makes and puts into a Bullet world. It belongs to Frond, but a host that clears its world
// deletes all objects in it: the owner then learns of it from the destructor, and touches nothing of the Bullet world,
// whose lists the host may be going through.
#pragma once

#include <memory>

#include "frond/frond_bullet.hpp"

namespace frond {
inline namespace FROND_BULLET_PRECISION {

// Owners have a function host_deleted(Owner&, Base&), found by their namespace.
template <class Base, class Owner>
struct Lent final : Base {
    Owner* owner;  // null: Frond itself deletes the object
    template <class... Arguments>
    explicit Lent(Owner* owner, Arguments&&... arguments) : Base(std::forward<Arguments>(arguments)...), owner(owner) {}
    ~Lent() override {
        if (owner) host_deleted(*owner, static_cast<Base&>(*this));
    }
};

struct TakeBack {
    template <class Base, class Owner>
    void operator()(Lent<Base, Owner>* object) const {
        object->owner = nullptr;
        delete object;
    }
};
template <class Base, class Owner>
using Loan = std::unique_ptr<Lent<Base, Owner>, TakeBack>;

// Leaves an object to the host, which is deleting it.
template <class Base, class Owner>
void leave_to_host(Loan<Base, Owner>& object) {
    static_cast<void>(object.release());
}

template <class Base, class Owner, class... Arguments>
Loan<Base, Owner> lend(Owner& owner, Arguments&&... arguments) {
    return Loan<Base, Owner>(new Lent<Base, Owner>(&owner, std::forward<Arguments>(arguments)...));
}

}  // namespace FROND_BULLET_PRECISION
}  // namespace frond
