// The problems' runs and baselines; problems.cpp is their table.
#pragma once

#include "study/trial.hpp"

namespace frond::study {

Setup static_baseline();  // a stem of 10 segments, material damping off
Setup motion_baseline();  // the same at 1/240 s
Setup free_baseline();    // not held anywhere
Setup peers_baseline();   // the beam of 1170 tets that other programs were tested with
Setup twig_baseline();
Setup wind_baseline();      // with damping, so that it comes to rest
Setup standing_baseline();  // a plant from a file, with default settings
Setup agree_baseline();     // the same at 1/120 s

Outcome run_cantilever_tip(const Setup& setup, Session& session);
Outcome run_cantilever_weight(const Setup& setup, Session& session);
Outcome run_aspect(const Setup& setup, Session& session);
Outcome run_elastica_tip(const Setup& setup, Session& session);
Outcome run_elastica_weight(const Setup& setup, Session& session);
Outcome run_roll_up(const Setup& setup, Session& session);
Outcome run_torsion(const Setup& setup, Session& session);
Outcome run_greenhill(const Setup& setup, Session& session);
Outcome run_peers(const Setup& setup, Session& session);

Setup stem_baseline();       // rods of a stem of Frond's own, 20 capsules
Setup free_stem_baseline();  // the same, not held anywhere
Setup carried_baseline();    // a cage with damping proportional to stiffness
Outcome run_heavy_cantilever(const Setup& setup, Session& session);
Outcome run_cone(const Setup& setup, Session& session);
Outcome run_bend_45(const Setup& setup, Session& session);
Outcome run_arc(const Setup& setup, Session& session);
Outcome run_lateral_tip(const Setup& setup, Session& session);
Outcome run_lateral_weight(const Setup& setup, Session& session);
Outcome run_spinning_rod(const Setup& setup, Session& session);
Outcome run_moving_root(const Setup& setup, Session& session);
Outcome run_sliding_block(const Setup& setup, Session& session);

Outcome run_free_fall(const Setup& setup, Session& session);
Outcome run_frequencies(const Setup& setup, Session& session);
Outcome run_damping(const Setup& setup, Session& session);
Outcome run_amplitude(const Setup& setup, Session& session);
Outcome run_far_amplitude(const Setup& setup, Session& session);
// Follows two periods after a light push on the end of a beam, compared with the sum of its modes.
Outcome sway_of(const Beam& beam, const Setup& setup, Session& session);
Outcome run_sway(const Setup& setup, Session& session);
Outcome run_swing(const Setup& setup, Session& session);
Outcome run_peers_swing(const Setup& setup, Session& session);
Outcome run_release(const Setup& setup, Session& session);

Outcome run_twig(const Setup& setup, Session& session);

Setup breeze_baseline();  // a plant of rods from a file, with default settings

Outcome run_reconfiguration(const Setup& setup, Session& session);

Outcome run_breeze(const Setup& setup, Session& session);

Outcome run_agree(const Setup& setup, Session& session);

Outcome run_corn_stand(const Setup& setup, Session& session);
Outcome run_cucumber_stand(const Setup& setup, Session& session);
Outcome run_corn_drift(const Setup& setup, Session& session);
Outcome run_cucumber_drift(const Setup& setup, Session& session);
Outcome run_corn_drag(const Setup& setup, Session& session);
Outcome run_cucumber_drag(const Setup& setup, Session& session);
Outcome run_corn_release(const Setup& setup, Session& session);
Outcome run_cucumber_release(const Setup& setup, Session& session);

}  // namespace frond::study
