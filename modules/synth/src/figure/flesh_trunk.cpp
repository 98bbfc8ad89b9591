// The tables of trunk and head, in statures. The numbers are the author's, set by eye within the breadths and
// depths of the anthropometric surveys.
#include <algorithm>

#include <Eigen/Geometry>

#include "figure/flesh.hpp"

namespace bodice::inline v0_1::synth {
namespace {

/// A row for one sex, with the share of `fat` that each direction takes.
struct TrunkRow {
  double y;
  double side, front, back;              // radii of the slim body
  double fat_side, fat_front, fat_back;  // their growth for fat 1
};

std::vector<TrunkRow> trunk_rows(const Figure& f) {
  const body::Proportions& p = f.p;
  const double c = p.crotch_height, w = p.waist_height, ch = p.chest_height, ax = p.axilla_height;
  const double ac = p.acromion_height, n = p.neck_height;
  const double low = c + 0.38 * (w - c), rib = w + 0.58 * (ch - w);
  if (f.female() > 0.0)
    return {{c + 0.03, .080, .050, .050, .40, .40, .45},    {c + 0.06, .097, .055, .054, .50, .75, .55},
            {low + 0.025, .094, .059, .049, .60, 1.2, .65}, {w, .080, .061, .042, .75, 1.5, .80},
            {w + 0.035, .074, .060, .043, .75, 1.4, .80},   {rib, .076, .058, .050, .55, 1.1, .75},
            {ch, .083, .056, .056, .35, .80, .70},          {ax, .087, .052, .059, .22, .65, .65},
            {ax + 0.03, .084, .041, .058, .15, .45, .50},   {ac - 0.008, .066, .024, .048, .10, .25, .35},
            {n - 0.006, .038, .014, .036, .10, .10, .20}};
  return {{c + 0.03, .078, .048, .052, .40, .40, .45},    {c + 0.06, .090, .052, .056, .50, .80, .55},
          {low + 0.025, .088, .055, .050, .60, 1.3, .70}, {w, .083, .057, .044, .65, 1.6, .85},
          {w + 0.035, .081, .057, .046, .60, 1.6, .85},   {rib, .086, .058, .054, .45, 1.2, .75},
          {ch, .092, .060, .060, .30, .80, .70},          {ax, .094, .056, .062, .20, .65, .65},
          {ax + 0.03, .090, .045, .060, .15, .45, .50},   {ac - 0.008, .072, .027, .050, .10, .25, .35},
          {n - 0.006, .043, .016, .038, .10, .10, .20}};
}

std::vector<Section> trunk_sections(const Figure& f) {
  std::vector<Section> sections;
  int row_number = 0;
  for (const TrunkRow& row : trunk_rows(f)) {
    const double build = row_number < 3 ? f.build.hip : row_number < 6 ? f.build.waist : f.build.chest;
    const auto grown = [&](double radius, double share) {
      return build * radius * std::max(1.0 + share * f.fat, 0.4);
    };
    Section section;
    section.s = row.y;
    section.side = grown(row.side, row.fat_side);
    section.front = grown(row.front, row.fat_front);
    section.back = grown(row.back, row.fat_back);
    sections.push_back(section);
    ++row_number;
  }
  return sections;
}

Loft blob(const Vec3& center, double x, double up, double front, double back) {
  return {{center, Vec3::UnitY(), Vec3::UnitX(), Vec3::UnitZ()}, {{0.0, x, front, back, 0.0, 0.0}}, up, up};
}

}  // namespace

void Flesh::add_trunk(const Figure& f) {
  const body::Proportions& p = f.p;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  add(Region::kTrunk, {{Vec3(0, 0, -0.004), y, x, z}, trunk_sections(f), 0.03, 0.012, 0.25}, 0.0);
  const double fat = std::max(f.fat, -0.3);
  if (f.pregnant)
    add(Region::kTrunk, blob({0.0, p.waist_height - 0.012, 0.035}, 0.068, 0.085, 0.075, 0.04), 0.03);
  for (int side = 0; side < 2; ++side) {  // the yoke from the neck to the shoulders
    const Vec3 inner(side == 0 ? 0.012 : -0.012, p.neck_height - 0.014, -0.018);
    const Vec3 outer = f.joint[index(of_side(Bone::kUpperArmL, side))] + Vec3(0.0, 0.004, 0.0);
    const double r = 0.026 * (1.0 + 0.25 * fat), length = (outer - inner).norm();
    const Vec3 along = (outer - inner) / length, front = (z - z.dot(along) * along).normalized();
    add(Region::kTrunk,
        {{inner, along, front.cross(along), front},
         {{0.0, 0.9 * r, r, r, 0, 0}, {length, r, r, r, 0, 0}},
         r,
         r},
        0.02);
  }
  for (const double sign : {1.0, -1.0}) {
    const double seat = f.build.seat * (1.0 + 0.35 * fat) * (f.female() > 0.0 ? 1.0 : 0.92);
    add(Region::kTrunk,
        blob({sign * 0.043, p.crotch_height + 0.045, -0.034}, 0.042 * seat, 0.046 * seat, 0.03, 0.045 * seat),
        0.02);
    if (f.female() > 0.0) {
      const double bust = f.build.bust * (1.0 + 0.5 * fat);
      add(Region::kTrunk,
          blob({sign * 0.04, p.chest_height - 0.004, 0.034}, 0.033 * bust, 0.034 * bust, 0.040 * bust, 0.03),
          0.018);
    } else {
      add(Region::kTrunk,
          blob({sign * 0.04, p.chest_height + 0.012, 0.034}, 0.04, 0.03, 0.026 * (1.0 + 0.4 * fat), 0.03),
          0.02);
    }
  }
}

void Flesh::add_head(const Figure& f) {
  const double hl = f.p.head_length, chin = 1.0 - hl;
  const double g = f.build.head, wide = 1.0 + 0.15 * std::max(f.fat, -0.5),
               cheek = 1.0 + 0.3 * std::max(f.fat, -0.4);
  const Vec3 x = Vec3::UnitX(), z = Vec3::UnitZ();
  const double neck =
      (f.female() > 0.0 ? 0.0315 : 0.0365) * f.build.neck * (1.0 + 0.25 * std::max(f.fat, -0.4));
  const Vec3 foot(0.0, f.p.neck_height - 0.035, -0.017), top(0.0, chin + 0.05, 0.002);
  const Vec3 along = (top - foot).normalized();
  const double length = (top - foot).norm();
  add(Region::kHead,
      {{foot, along, x, along.cross(x).z() > 0 ? Vec3(along.cross(x)) : Vec3(-along.cross(x))},
       {{0.0, 1.15 * neck, neck, 1.1 * neck, 0, 0},
        {0.5 * length, neck, neck, neck, 0, 0},
        {length, neck, neck, neck, 0, 0}},
       0.01,
       0.01},
      0.025);
  const auto row = [&](double t, double side, double front, double back) -> Section {
    const double share = t < 0.4 ? cheek : wide;
    return {chin + t * hl, g * share * side, g * front, g * back, 0.0, 0.0};
  };
  add(Region::kHead,
      {{Vec3(0, 0, 0.008), Vec3::UnitY(), x, z},
       {row(0.03, .0215, .049, .018), row(0.14, .0325, .0555, .034), row(0.32, .0405, .0575, .046),
        row(0.48, .0445, .0575, .0535), row(0.6, .0455, .0575, .056), row(0.68, .0445, .0555, .0545)},
       0.035 * hl,
       0.32 * hl,
       0.06},
      0.012);
  add(Region::kHead, blob({0.0, chin + 0.36 * hl, 0.066}, 0.0085, 0.014, 0.013, 0.02), 0.009);
  for (const double sign : {1.0, -1.0})
    add(Region::kHead, blob({sign * 0.0455 * wide * g, chin + 0.47 * hl, -0.002}, 0.008, 0.019, 0.009, 0.012),
        0.004);
}

}  // namespace bodice::synth
