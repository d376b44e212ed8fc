/* frond.h - plants that bend, for worlds simulated by the Bullet physics engine. Compiles as C99 and as C++.
 *
 * A plant is made in three steps: a *model* (shape and material, read-only, shared), a *world* (a Bullet world; Frond
 * makes one, or frond_bullet.hpp attaches to yours), and a *plant* (one instance that moves).
 *
 *   frond_types.h   version, results, handles, choices, tuning
 *   frond_core.h    world, wind, model, plant, fragments, detail, grabs, rigid bodies, bonds: all that a game calls
 *   frond_expert.h  profile, states by nodes, energies, cage and chain, other mechanics while a plant runs, advice
 *
 * Robots are in frond_robot.h, snapshots in frond_snapshot.h. Terms are explained in GLOSSARY.md.
 *
 * Units      SI everywhere: metre, kilogram, second, radian, newton, pascal.
 * Numbers    double in the simulation, float in data for a GPU. Right-handed. A model's own up axis is +y after
 *            import; in the world gravity alone decides what is down.
 * Defaults   Make every def with its frond_default_*_def(), then change fields.
 * Ownership  Each *_create, *_load or *_from_* has one *_destroy. Defs, arrays and strings passed in are copied.
 *            Pointers inside a *_view are borrowed: those of a model live as long as the model, those of a plant die at
 *            the next step or destroy.
 * Errors     Zero (FROND_OK) is success. On failure the call changed nothing, out parameters are zeroed, and
 *            frond_last_error() says what was wrong and what to do. Wrong input never aborts the program.
 * Threads    One world, one thread at a time. Different worlds may be used from different threads. Models are
 *            read-only and may be shared by all of them. Within a step a world may use threads that the host provides:
 *            frond_world_def.parallel_for.
 */
#ifndef FROND_H
#define FROND_H

#include "frond/frond_core.h"
#include "frond/frond_expert.h"
#include "frond/frond_types.h"

#endif /* FROND_H */
