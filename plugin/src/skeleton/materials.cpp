// Materials: one row per kind of organ. In: a kind's name. Out: constants of fresh, living tissue, SI units.
//
// The table gives the modulus of the whole organ in bending along its axis (rind, pith and cavity together), because
// that is what a rod or a calibrated cage of one material needs; so every preset is solid. For a hollow culm give the
// wall's modulus and `hollow`. Fresh tissue is mostly water, so its density is near 1000 kg/m^3; Poisson's ratio of wet
// tissue is near 0.3 if it is taken as a solid that includes the air spaces. "Estimate" marks a value without a source,
// and says what it follows from. Sources:
//   [1] Xu 2016: cucumber stem at root, middle and head: modulus 281, 199, 137 MPa; strength 7.35, 6.30, 4.68 MPa at
//       strains of 2.6-3.4 %; the root part yields, the rest is brittle.
//   [2] Agriculture 2022, 12(10), 1519, doi 10.3390/agriculture12101519: broccoli stem, 940-1056 kg/m^3; rind 27-48,
//       xylem 19-111, pith 6.5-7.5 MPa; bending strength 6.9 MPa.
//   [3] Al-Zube, Sun, Robertson, Cook 2018, doi 10.1186/s13007-018-0279-6: rind of dry maize stalks 6-16 GPa; Plant
//       Methods 2023, doi 10.1186/s13007-023-01039-5: pith 1/17 of it, rind softer and pith stiffer when wet.
//   [4] Cannell, Morgan 1987, Tree Physiology 3, 355-364, doi 10.1093/treephys/3.4.355: living branches with bark
//       0.7-4.6 GPa, trunks 2.4-7.5 GPa.
//   [5] Kobayashi, Daimaruya, Kuribayashi 2000, J. Soc. Mater. Sci. Japan 49(12), 1318-1323: butterbur leaf, veins
//       about 60 MPa, lamina about 1/11 of that.
//   [6] Moulia, Fournier 1997, doi 10.1023/A:1018604012754, and Moulia, Fournier, Guitard 1994, doi 10.1007/BF00363427:
//       the maize leaf is a sandwich beam whose midrib carries most of the bending.
//   [7] Langer, Kelbel, Speck, Mueller, Speck 2021, doi 10.3389/fpls.2021.765605: petioles of four herbs, EI/GJ 11.5
//       and 13.3 in dicots, 23.7 and 39.2 in monocots; they can bear 1.7-2.9 times their leaf. Sci. Rep. 2018, doi
//       10.1038/s41598-018-34588-0: petioles of four trees, 4.3 (2.7-8.0 after Vogel 1992).
//   [8] Lehmann, Kampowski, Caliaro, Speck, Speck 2019, Biol. Lett. 15(9), doi 10.1098/rsbl.2019.0254: Gerbera
//       peduncles, flexural rigidity falls when they wilt while the bending modulus stays the same.
//   [9] Gibson 2012, doi 10.1098/rsif.2012.0341: parenchyma 0.3-14 MPa, palm tissue up to 30 GPa, and wood in between.
//   [10] Rowe, Speck and others in the tables of tendril climbers: structural modulus of old stems below 1 GPa, young
//       ones stiffer; Gerbode, Puzey, McCormick, Mahadevan 2012, doi 10.1126/science.1223304: cucumber tendrils.
//   [11] Boldrin, Leung, Bengough 2018, doi 10.1007/s11104-018-3766-7: woody roots are softest when hydrated; Vautrin
//       and others 2018, arXiv 1804.08879: chick-pea roots, not lignified, a few to tens of MPa.
//   [12] Etnier, Vogel 2000, Am. J. Bot. 87(1), 29-32, doi 10.2307/2656682: EI/GJ of the flower stems of tulips 8.33,
//       of daffodils 13.27.
//   [13] Wolff-Vorbeck, Speck, Langer, Speck, Dondl 2022, J. R. Soc. Interface (PMC9214286): calculated EI/GJ from 0.85
//       (strands in the middle) to 196 (separate strands at the rim); a closed ring at the rim lies low among the
//       latter.
//   [14] Forest Products Laboratory 2010, Wood Handbook, FPL-GTR-190: softwoods, G about 1/20 to 1/10 of E along the
//       grain, so that EI/GJ = E / 2G is 5-10; modulus of rupture air-dry 60-100 MPa.
//   [15] Moore, Maguire 2004, Trees 18(2), 195-203: internal damping ratio of conifers mostly below 0.05.
//   [16] Speck, Spatz 2004, Am. J. Bot. 91(6), 789-796, doi 10.3732/ajb.91.6.789: the giant reed sways as a damped
//       oscillator, damped much more with leaves, by air and by its structure; de Langre 2008, Annu. Rev. Fluid Mech.
//       40, 141-168, doi 10.1146/annurev.fluid.40.111406.102135: damping ratios of a few to some tens of per cent.
//   [17] Lei, Wang, Lei, Liu 2022, BioResources 17(4), 5984-5998: static friction of fresh sugarcane tops, stem on stem
//       0.45, leaf on leaf 0.38.
//   [18] Agriculture 2024 (September), contact parameters of maize kernels: static friction on steel 0.545.
//   [19] Annals of Forest Science 2020, doi 10.1007/s13595-020-0926-8: fresh poplar stems, modulus of rupture 35-50
//       MPa; bending to a strain of 0.8 % damages the tissue permanently.
//   [20] Ray, Bret-Harte 2019, Front. Plant Sci. 10, 59, doi 10.3389/fpls.2019.00059: loaded branches creep by 30-50 %
//       of their first deflection; the permanent part comes within the first hours up to a day.
//   [21] Vincent 1991, J. Mater. Sci. 26, 1947-1950, doi 10.1007/BF00543628: strength of the sclerenchyma of grass
//       leaves 144 MPa; its share in the leaf is 2-30 %.
//   [22] Pohl, Stroude, Buttler, Rixen 2011, Ann. Bot. 108(3), 537-545, doi 10.1093/aob/mcr169: roots of alpine herbs
//       break at 2-8 MPa in thick and 18-30 MPa in fine ones.
//   [23] Klimm, Schmier, Bohn, Kleiser, Thielen, Speck 2021, J. Exp. Bot.: passion-flower tendrils bear up to 2 N.
//   [24] Zhang and others 2016, BioResources 11(3): maize rind is elastic-plastic, strength in tension 80-178 MPa.
//   [25] O'Dogherty, Huber, Dyson, Marshall 1995, J. Agric. Eng. Res. 62(2), 133-142, doi 10.1006/jaer.1995.1072: wheat
//       straw, Young's modulus 4.8-6.6 GPa, strength in tension 21-31 MPa.
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "skeleton/organ.hpp"

namespace frond {

struct MaterialRow {
    const char* kind;
    Material material;
};

// Values that hold for more than one row, all estimates:
// - damping_ratio of soft organs is twice that of wood [15]: their tissue is wetter, and pith and rind shear against
//   each other; it is well below that of whole plants [16], which air and leaves damp in addition.
// - yield_strain is nine tenths of the strain at which the organ breaks if a source calls the organ brittle [1], two
//   thirds if it calls it elastic-plastic or if nothing is known.
// - creep_rate: wood creeps within hours [20]: 1e-4 / s. Primary walls, turgid and not lignified, creep within a
//   quarter of an hour.
// - midrib of blades: maize, 4 mm of 80 mm.
// - restitution is zero: what a plant gives back it gives by its own spring.
// - drag is zero, so that it follows from the shape: see plant/air_pieces.cpp.
// - fruit, flower, root and tendril have their strands in the middle or none, so they are near isotropic [13]; blades
//   twist as strips.
constexpr double ISOTROPIC = 0, WOOD_CREEP = 1e-4, HERB_CREEP = 1e-3, BY_SHAPE = 0, NONE = 0, MAIZE_RIB = 0.05;

// density [kg/m^3], young [Pa], poisson, thickness [m]; hollow, twist_to_bend, damping_ratio, friction; yield_strain,
// creep_rate [1/s], strength [Pa], drag, midrib, restitution
static const MaterialRow MATERIALS[] = {
    // Middle of a cucumber stem, brittle [1]; wall of an open tube: rind. Friction [17]. Twist: estimate, a closed ring
    // at the rim [13], between isotropic and the tulip [12].
    {"stem", {1000, 2.0e8, 0.30, 1.5e-3, 0, 4, 0.06, 0.45, 0.028, HERB_CREEP, 6.3e6, BY_SHAPE, NONE, NONE}},
    // Green maize as a whole: a rind of 6-16 GPa dry, less when wet, around a pith of 1/17 of it [3]. Strength:
    // estimate, the rind breaks at a strain of 1.1-1.3 % [3], [24], the whole stalk with it. Twist as the tulip's, a
    // monocot's round stem [12]. Friction [17]. Damping and creep lie between those of herbs and wood.
    {"grass_stem", {950, 1.5e9, 0.30, 1.0e-3, 0, 8.3, 0.05, 0.45, 0.008, 3e-4, 1.8e7, BY_SHAPE, NONE, NONE}},
    // Culms of small cereals: hollow, with the least modulus of wheat's straw [25], as they are green. The rest as
    // above,
    // the strength by the strain at which maize breaks: straw, at 31 MPa, is more brittle.
    {"cereal_stem", {950, 4.8e9, 0.30, 0.5e-3, 0.7, 8.3, 0.05, 0.45, 0.008, 3e-4, 5.6e7, BY_SHAPE, NONE, NONE}},
    // Chosen: between veins [5] and stems [1]; carries a blade with the safety factors of [7]. Twist: the two dicots of
    // [7]. Strength: estimate, breaks at the strain of stems [1].
    {"petiole", {980, 1.5e8, 0.30, 1.0e-3, 0, 12, 0.06, 0.45, 0.022, HERB_CREEP, 5e6, BY_SHAPE, NONE, NONE}},
    // Chosen between a dicot's lamina (5-6 MPa) with its veins (60 MPa) [5] and the stiffer grasses: a blade drawn as a
    // bare sheet has to carry what the midrib carries in life [6]. Leaves are 0.2-0.5 mm thick. Friction [17].
    // Strength: estimate, a wet sheet stretches by 5 % before it tears.
    {"blade",
     {900, 3.0e7, 0.30, 0.4e-3, 0, ISOTROPIC, 0.08, 0.38, 0.033, HERB_CREEP, 1.5e6, BY_SHAPE, MAIZE_RIB, NONE}},
    // Chosen: the sclerenchyma of its many parallel veins and midrib carries most of the bending [6]. Strength: that of
    // sclerenchyma times a share of 8 % [21]. Friction [17].
    {"grass_blade",
     {900, 3.0e8, 0.30, 0.3e-3, 0, ISOTROPIC, 0.06, 0.38, 0.025, HERB_CREEP, 1.15e7, BY_SHAPE, MAIZE_RIB, NONE}},
    // Veins 60 MPa in tension [5]; the sclerenchyma on the lower side of a maize midrib is stiffer [6]. Twist and
    // strain at failure as the petiole, which it continues. Friction of leaves [17].
    {"midrib", {950, 8.0e7, 0.30, 2.0e-3, 0, 12, 0.06, 0.38, 0.022, HERB_CREEP, 2.7e6, BY_SHAPE, NONE, NONE}},
    // A tube of parenchyma with a stiff rim [8]; between broccoli [2] and cucumber [1]. Twist of the tulip [12].
    // Strength: estimate, the strain of stems [1]; half of broccoli's 6.9 MPa [2].
    {"peduncle", {980, 1.0e8, 0.30, 1.0e-3, 0, 8.3, 0.06, 0.45, 0.022, HERB_CREEP, 3.3e6, BY_SHAPE, NONE, NONE}},
    // Parenchyma without veins to speak of [9]. Strength: estimate, soft tissue breaks at some 6 %. Friction of leaves
    // [17].
    {"flower", {900, 5.0e6, 0.30, 0.3e-3, 0, ISOTROPIC, 0.10, 0.38, 0.04, HERB_CREEP, 3e5, BY_SHAPE, NONE, NONE}},
    // Parenchyma under turgor, with its skin [9]. Friction: maize kernels [18], for want of others. Strength: estimate,
    // as flower, with a skin: 8 %.
    {"fruit", {980, 5.0e6, 0.35, 3.0e-3, 0, ISOTROPIC, 0.10, 0.55, 0.053, HERB_CREEP, 4e5, BY_SHAPE, NONE, NONE}},
    // The middle of living branches [4]; green wood sinks or nearly so. Twist [14], damping [15], yield and strength
    // [19], creep [20]. Friction: estimate, bark is rougher than stems.
    {"branch", {950, 3.0e9, 0.35, 3.0e-3, 0, 7, 0.03, 0.5, 0.008, WOOD_CREEP, 4.5e7, BY_SHAPE, NONE, NONE}},
    // Foliage drawn as one solid: leaves, twigs and mostly air. Estimates: 2-5 m^2 of leaf per cubic metre, 0.25 kg per
    // m^2 when fresh, and as much again in twigs; stiff enough to keep its shape and too soft to hold up the branches
    // in it. It neither yields nor breaks.
    {"crown", {4, 5.0e4, 0.20, 0.4e-3, 0, ISOTROPIC, 0.10, 0.38, 0, 0, 0, BY_SHAPE, NONE, NONE}},
    // Hydrated: between herbs and wood [11]. Strength: thick roots of herbs [22]. Friction: estimate, as bark.
    {"root", {1000, 2.0e8, 0.35, 2.0e-3, 0, ISOTROPIC, 0.06, 0.5, 0.025, HERB_CREEP, 7.5e6, BY_SHAPE, NONE, NONE}},
    // Thin, lignified late [10]. Strength: 2 N [23] on a tendril of half a millimetre. Friction: estimate, they hold on
    // by ridges and hooks.
    {"tendril", {950, 2.0e8, 0.30, 0.5e-3, 0, ISOTROPIC, 0.08, 0.6, 0.033, HERB_CREEP, 1.0e7, BY_SHAPE, NONE, NONE}},
    // Not a plant: stakes, trellises, pots. Air-dry softwood [14], which neither yields nor creeps within a day;
    // friction of wood on wood and damping of dry wood: estimates.
    {"support", {600, 8.0e9, 0.35, 5.0e-3, 0, 7, 0.02, 0.4, 0, 0, 8.0e7, BY_SHAPE, NONE, NONE}},
};

const Material* material_preset(const std::string& kind) {
    for (const MaterialRow& row : MATERIALS)
        if (kind == row.kind) return &row.material;
    return nullptr;
}

bool is_sheet(const Organ& organ) {
    return organ.kind == "blade" || organ.kind == "flower";
}

// A leaf weighs the same with one face or two. A flower may be a head, of bracts, disc and seeds.
double solid_thickness(const Organ& organ) {
    constexpr double HEAD = 3e-3;  // [m]
    if (!is_sheet(organ)) return INFINITY;
    return std::max(organ.kind == "flower" ? HEAD : 0, 2 * organ.material.thickness);
}

std::string material_kinds() {
    std::string text;
    for (const MaterialRow& row : MATERIALS) text += (text.empty() ? "" : ", ") + std::string(row.kind);
    return text;
}

// Zero is allowed for a property that a material need not have; other tiny values are rejected where something is
// divided by the property.
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
                  {"strength [Pa]", material.strength, 1, 1e12, true},
                  {"drag", material.drag, 0.01, 10, true},
                  {"midrib", material.midrib, 0, 0.5, false},
                  {"restitution", material.restitution, 0, 1, false}};
    for (const auto& range : ranges) {
        if (range.value >= range.least && range.value <= range.most) continue;
        if (range.or_zero && range.value == 0) continue;
        fail(FROND_RESULT_BAD_ARGUMENT, "%s of organ \"%s\" is %g; give a value from %g to %g%s", range.what,
             who.c_str(), range.value, range.least, range.most, range.or_zero ? ", or 0 for none" : "");
    }
}

}  // namespace frond
