// Materials: one row a kind of organ. In: a kind's name. Out: constants of fresh, living tissue, SI units.
//
// What is tabulated is the modulus of the whole organ in bending along its axis (rind and pith together), because that
// is what a rod or a calibrated cage of one material needs. Fresh tissue is mostly water, so its density is near 1000
// kg/m^3; Poisson's ratio of wet tissue taken as solid is near 0.3 when the air spaces are counted in. Sources:
//   [1] Xu 2016: cucumber stem, modulus 281 / 199 / 137 MPa at root, middle and head.
//   [2] Agriculture 2022, 12(10), 1519, doi 10.3390/agriculture12101519: broccoli stem, 940-1056 kg/m^3; rind 27-48,
//       xylem 19-111, pith 6.5-7.5 MPa.
//   [3] Al-Zube, Sun, Robertson, Cook 2018, doi 10.1186/s13007-018-0279-6: rind of dry maize stalks 6-16 GPa; Plant
//   Methods
//       2023, doi 10.1186/s13007-023-01039-5: pith 1/17 of it, rind softer and pith stiffer when wet.
//   [4] Cannell, Morgan 1987, Tree Physiology 3, 355-364, doi 10.1093/treephys/3.4.355: living branches with bark
//       0.7-4.6 GPa, trunks 2.4-7.5 GPa.
//   [5] Kobayashi, Daimaruya, Kuribayashi 2000, J. Soc. Mater. Sci. Japan 49(12), 1318-1323: butterbur leaf, veins
//   about
//       60 MPa, lamina about 1/11 of that.
//   [6] Moulia, Fournier 1997, doi 10.1023/A:1018604012754, and Moulia, Fournier, Guitard 1994, doi 10.1007/BF00363427:
//       the maize leaf is a sandwich beam whose midrib carries most of the bending.
//   [7] Langer, Kelbel, Speck, Mueller, Speck 2021, doi 10.3389/fpls.2021.765605: petioles of four herbs bear 1.7-2.9
//   times
//       their leaf; Sci. Rep. 2018, doi 10.1038/s41598-018-34588-0: petioles of four trees.
//   [8] Lehmann, Kampowski, Caliaro, Speck, Speck 2019, Biol. Lett. 15(9), doi 10.1098/rsbl.2019.0254: Gerbera
//   peduncles,
//       flexural rigidity falls when they wilt while the bending modulus keeps.
//   [9] Gibson 2012, doi 10.1098/rsif.2012.0341: parenchyma 0.3-14 MPa, palm tissue up to 30 GPa, and wood in between.
//   [10] Rowe, Speck and others in the tables of tendril climbers: structural modulus of old stems below 1 GPa, young
//   ones
//       stiffer; Gerbode, Puzey, McCormick, Mahadevan 2012, doi 10.1126/science.1223304: cucumber tendrils.
//   [11] Boldrin, Leung, Bengough 2018, doi 10.1007/s11104-018-3766-7: woody roots are softest when hydrated; Vautrin
//   and others
//       2018, arXiv 1804.08879: chick-pea roots, not lignified, a few to tens of MPa.
#include <cmath>

#include "core/error.hpp"
#include "model/organ.hpp"

namespace frond {

struct MaterialRow {
    const char* kind;
    Material material;  // density [kg/m^3], young [Pa], poisson [-], thickness [m]
};

static const MaterialRow MATERIALS[] = {
    // Cucumber, its middle [1]. Wall of an open tube: rind.
    {"stem", {1000, 2.0e8, 0.30, 1.5e-3, 0, 0, 0, 0, 0, 0, 0}},
    // Green maize as a whole: a rind of 6-16 GPa dry, less when wet, around a pith of 1/17 of it [3].
    {"grass_stem", {950, 1.5e9, 0.30, 1.0e-3, 0, 0, 0, 0, 0, 0, 0}},
    // Chosen: between veins [5] and stems [1]; carries a blade with the safety factors of [7].
    {"petiole", {980, 1.5e8, 0.30, 1.0e-3, 0, 0, 0, 0, 0, 0, 0}},
    // Chosen between a dicot's lamina (5-6 MPa) with its veins (60 MPa) [5] and the stiffer grasses: a blade drawn as a
    // bare
    // sheet has to carry what the midrib carries in life [6]. Leaves are 0.2-0.5 mm thick.
    {"blade", {900, 3.0e7, 0.30, 0.4e-3, 0, 0, 0, 0, 0, 0, 0}},
    // Chosen: the sclerenchyma of its many parallel veins and midrib carries most of the bending [6].
    {"grass_blade", {900, 3.0e8, 0.30, 0.3e-3, 0, 0, 0, 0, 0, 0, 0}},
    // Veins 60 MPa in tension [5]; the sclerenchyma on the lower side of a maize midrib is stiffer [6].
    {"midrib", {950, 8.0e7, 0.30, 2.0e-3, 0, 0, 0, 0, 0, 0, 0}},
    // A tube of parenchyma with a stiff rim [8]; between broccoli [2] and cucumber [1].
    {"peduncle", {980, 1.0e8, 0.30, 1.0e-3, 0, 0, 0, 0, 0, 0, 0}},
    // Parenchyma without veins to speak of [9].
    {"flower", {900, 5.0e6, 0.30, 0.3e-3, 0, 0, 0, 0, 0, 0, 0}},
    // Parenchyma under turgor, with its skin [9].
    {"fruit", {980, 5.0e6, 0.35, 3.0e-3, 0, 0, 0, 0, 0, 0, 0}},
    // The middle of living branches [4]; green wood sinks or nearly so.
    {"branch", {950, 3.0e9, 0.35, 3.0e-3, 0, 0, 0, 0, 0, 0, 0}},
    // Hydrated: between herbs and wood [11].
    {"root", {1000, 2.0e8, 0.35, 2.0e-3, 0, 0, 0, 0, 0, 0, 0}},
    // Thin, lignified late [10].
    {"tendril", {950, 2.0e8, 0.30, 0.5e-3, 0, 0, 0, 0, 0, 0, 0}},
    // Not a plant: stakes, trellises, pots. Air-dry softwood.
    {"support", {600, 8.0e9, 0.35, 5.0e-3, 0, 0, 0, 0, 0, 0, 0}},
};

const Material* material_preset(const std::string& kind) {
    for (const MaterialRow& row : MATERIALS)
        if (kind == row.kind) return &row.material;
    return nullptr;
}

std::string material_kinds() {
    std::string text;
    for (const MaterialRow& row : MATERIALS) text += (text.empty() ? "" : ", ") + std::string(row.kind);
    return text;
}

// Zero is allowed where a material need not have a property; tiny values besides are not, where others are divided by
// them.
void check_material(const Material& material, const std::string& who) {
    const struct {
        const char* what;
        double value, least, most;
        bool or_zero;
    } ranges[] = {{"density [kg/m^3]", material.density, 1, 2e4, false},
                  {"young [Pa]", material.young, 1e3, 1e12, false},
                  {"poisson", material.poisson, 0, 0.499, false},
                  {"thickness [m]", material.thickness, 1e-6, 1, false},
                  {"hollow", material.hollow, 0, 0.98, false},
                  {"twist_to_bend", material.twist_to_bend, 0.01, 100, true},
                  {"damping_ratio", material.damping_ratio, 0, 1, false},
                  {"friction", material.friction, 0, 100, false},
                  {"yield_strain", material.yield_strain, 1e-6, 10, true},
                  {"creep_rate [1/s]", material.creep_rate, 0, 1e6, false},
                  {"strength [Pa]", material.strength, 1, 1e12, true}};
    for (const auto& range : ranges) {
        if (range.value >= range.least && range.value <= range.most) continue;
        if (range.or_zero && range.value == 0) continue;
        fail(FROND_BAD_ARGUMENT, "%s of organ \"%s\" is %g; give a value from %g to %g%s", range.what, who.c_str(),
             range.value, range.least, range.most, range.or_zero ? ", or 0 for none" : "");
    }
}

}  // namespace frond
