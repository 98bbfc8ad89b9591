#include "bullet_sheet.hpp"

#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include "scene.hpp"

namespace bench {

using bodice::geometry::Vec3;

/// Bullet's world with its parts, in the order in which they refer to each other.
struct BulletSheet::World {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  btSphereShape ball{static_cast<btScalar>(kRadius_m)};
  std::unique_ptr<btRigidBody> body;
  std::unique_ptr<btSoftBody> sheet;
};

namespace {

std::unique_ptr<btSoftBody> make_soft_body(btSoftBodyWorldInfo& info, const bodice::geometry::TriMesh& mesh) {
  std::vector<btScalar> xyz;
  for (const Vec3& p : mesh.positions)
    for (const double value : {p.x(), p.y(), p.z()}) xyz.push_back(static_cast<btScalar>(value));
  std::vector<int> corners;
  for (const auto& t : mesh.triangles)
    for (const auto v : t) corners.push_back(static_cast<int>(v));
  std::unique_ptr<btSoftBody> sheet(btSoftBodyHelpers::CreateFromTriMesh(
      info, xyz.data(), corners.data(), static_cast<int>(mesh.triangles.size()), false));
  btSoftBody::Material* bending = sheet->appendMaterial();
  bending->m_kLST = btScalar(0.05);
  sheet->generateBendingConstraints(2, bending);
  sheet->m_cfg.piterations = 4;  // with one, 10k particles fly apart
  sheet->m_cfg.kDF = btScalar(0.45);
  sheet->m_cfg.kKHR = 1;  // hardness of contact with still bodies; by default a tenth of the depth a sweep
  sheet->m_cfg.collisions = btSoftBody::fCollision::SDF_RS;
  sheet->getCollisionShape()->setMargin(static_cast<btScalar>(kThickness_m));
  sheet->setTotalMass(btScalar(0.14 * 1.44));
  return sheet;
}

}  // namespace

BulletSheet::BulletSheet(const bodice::geometry::TriMesh& mesh) : world_(std::make_unique<World>()) {
  World& w = *world_;
  const btVector3 gravity(0, btScalar(-9.81), 0);
  w.world.setGravity(gravity);
  w.world.getWorldInfo().m_gravity = gravity;
  auto& field = w.world.getWorldInfo().m_sparsesdf;
  field.Initialize();
  field.setDefaultVoxelsz(btScalar(kRadius_m / 16));  // the default, 0.25 m, is the radius of the ball
  field.Reset();                                      // applies the size
  btTransform at_center = btTransform::getIdentity();
  at_center.setOrigin({btScalar(kCenter.x()), btScalar(kCenter.y()), btScalar(kCenter.z())});
  btRigidBody::btRigidBodyConstructionInfo still(0, nullptr, &w.ball);
  still.m_startWorldTransform = at_center;
  w.body = std::make_unique<btRigidBody>(still);
  w.world.addRigidBody(w.body.get());
  w.sheet = make_soft_body(w.world.getWorldInfo(), mesh);
  w.world.addSoftBody(w.sheet.get());
}

BulletSheet::~BulletSheet() {
  world_->world.removeSoftBody(world_->sheet.get());
  world_->world.removeRigidBody(world_->body.get());
}

void BulletSheet::step() {
  world_->world.stepSimulation(btScalar(kFrame_s), kSubsteps, btScalar(kFrame_s / kSubsteps));
}

std::vector<Vec3> BulletSheet::positions() const {
  std::vector<Vec3> out;
  for (int i = 0; i < world_->sheet->m_nodes.size(); ++i) {
    const btVector3& p = world_->sheet->m_nodes[i].m_x;
    out.emplace_back(double{p.x()}, double{p.y()}, double{p.z()});
  }
  return out;
}

}  // namespace bench
