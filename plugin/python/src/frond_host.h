/* frond_host.h - what the Python package needs beside Frond's C API: the door to PyBullet's world, and the forces of
 * whole calls. The rules of frond.h for units, ownership, errors and threads hold.
 */
#ifndef FROND_HOST_H
#define FROND_HOST_H

#include "frond/frond_robot.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns the text of this thread's last call of this header that failed. Never null. */
FROND_API const char* frond_host_last_error(void);
/* Takes out of a world what these functions put there; call it before frond_world_destroy. */
FROND_API void frond_host_release(frond_world world);

/* ---- PyBullet --------------------------------------------------------------------------------------------------- */

/* Puts plants into the world of the PyBullet server that loaded this library as its plugin. `plugin`: the number that
 * its command "attach" returned. Null def: the default. If the server has deleted the world of an earlier call, that
 * frond_world is freed. UNSUPPORTED for a PyBullet whose world is not found. */
FROND_API frond_result frond_host_attach(int plugin, const frond_world_def* def, frond_world* out);
/* Returns whether a world stands on a Bullet world that exists; frees it if PyBullet has deleted that. */
FROND_API bool frond_host_is_alive(frond_world world);
/* Keep the server's thread from stepping the world's plants, while another one reads them. */
FROND_API void frond_host_hold(frond_world world);
FROND_API void frond_host_let_go(frond_world world);
/* Finds the collision object of a body of PyBullet's by its unique id and link, -1 for the base; null if the world has
 * none. Borrowed from the server. */
FROND_API const void* frond_host_find_body(frond_world world, int body, int link);
/* Makes a bond to a collision object of the plant's Bullet world. */
FROND_API frond_result frond_host_bond(frond_plant plant, frond_vec3 point, const void* body, frond_bond* out);
/* Returns the address of the plant's collision object, a btCompoundShape of capsules; null for an invalid handle. */
FROND_API const void* frond_host_get_object(frond_plant plant);
/* Keeps PyBullet's window from drawing a plant's capsules, which it would not move. */
FROND_API void frond_host_hide(frond_plant plant);
/* Returns the plant of a collision object of the world's; null for any other address. */
FROND_API frond_plant frond_host_get_plant(frond_world world, const void* object);
/* Returns the address of the Bullet world, of a robot's multi-body, and of the motor of its joint; null for an invalid
 * handle, and for a joint that is fixed. */
FROND_API const void* frond_host_get_world(frond_world world);
FROND_API const void* frond_host_get_multi_body(frond_robot robot);
FROND_API const void* frond_host_get_motor(frond_robot robot, int link);

/* ---- forces ----------------------------------------------------------------------------------------------------- */

/* The force of a plant on a body, at one point in the last substep, or the mean over all substeps of a call. */
typedef struct frond_force {
    frond_plant plant;
    frond_plant other; /* the plant that touches it; null: a body */
    const void* body;  /* the collision object; null: a plant */
    int body_id;       /* PyBullet's unique id of the body; -1: it has none */
    int link;          /* its link; -1: the base */
    int capsule;       /* the plant's */
    frond_vec3 point;  /* on the plant [m]; of a mean, weighted by the forces */
    frond_vec3 normal; /* from the body to the plant, length one; of a mean, weighted likewise */
    frond_vec3 force;  /* on the plant [N]; the body has the opposite */
    frond_vec3 moment; /* of that force about the world's origin [N m] */
    double gap;        /* below zero they overlapped [m]; of a mean, the least */
} frond_force;

/* Records from now on the forces of each substep. A mean is over a call of PyBullet's stepSimulation, or of
 * frond_world_step after frond_host_begin_call. */
FROND_API frond_result frond_host_record(frond_world world);
FROND_API frond_result frond_host_begin_call(frond_world world);
/* Returns the number of rows of the table below. */
FROND_API int frond_host_get_force_count(frond_world world, bool mean);
/* Copies the table of forces of the last substep, or their means over the last call, a row for each plant, capsule and
 * body. count must be what frond_host_get_force_count returns. */
FROND_API frond_result frond_host_get_forces(frond_world world, bool mean, frond_force* out, int count);
/* Gives the mean over the last call of the force of the ground on a plant, and of its moment about the world's origin.
 * A plant is recorded from the first call on; until a step has been taken, the present force is given. */
FROND_API frond_result frond_host_get_root_force(frond_plant plant, frond_vec3* force, frond_vec3* moment);
/* Gives the mean over the last call of the force of a bond of this world on its plant; as above. */
FROND_API frond_result frond_host_get_bond_force(frond_world world, frond_bond bond, frond_vec3* force);

#ifdef __cplusplus
}
#endif
#endif /* FROND_HOST_H */
