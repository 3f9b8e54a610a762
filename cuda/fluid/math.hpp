// Small vectors and matrices, for host and device.
#pragma once

#include <cmath>

#include "backend/platform.hpp"

namespace slagflow {

template <class T>
struct Vector3 {
  T x{}, y{}, z{};

  HOST_DEVICE T& operator[](int k) { return k == 0 ? x : (k == 1 ? y : z); }
  HOST_DEVICE T operator[](int k) const { return k == 0 ? x : (k == 1 ? y : z); }
  HOST_DEVICE Vector3& operator+=(Vector3 b) { return x += b.x, y += b.y, z += b.z, *this; }
  HOST_DEVICE Vector3& operator-=(Vector3 b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  HOST_DEVICE Vector3& operator*=(T s) { return x *= s, y *= s, z *= s, *this; }

  friend HOST_DEVICE Vector3 operator+(Vector3 a, Vector3 b) { return a += b; }
  friend HOST_DEVICE Vector3 operator-(Vector3 a, Vector3 b) { return a -= b; }
  friend HOST_DEVICE Vector3 operator-(Vector3 a) { return {-a.x, -a.y, -a.z}; }
  friend HOST_DEVICE Vector3 operator*(Vector3 a, T s) { return a *= s; }
  friend HOST_DEVICE Vector3 operator*(T s, Vector3 a) { return a *= s; }
  friend HOST_DEVICE bool operator==(Vector3 a, Vector3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
};

using Vec3 = Vector3<Real>;
using Vec3d = Vector3<double>;

template <class T>
HOST_DEVICE T dot(Vector3<T> a, Vector3<T> b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class T>
HOST_DEVICE Vector3<T> cross(Vector3<T> a, Vector3<T> b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
HOST_DEVICE T norm(Vector3<T> a) {
  return std::sqrt(dot(a, a));
}

HOST_DEVICE inline Vec3 to_real(Vec3d a) {
  return {static_cast<Real>(a.x), static_cast<Real>(a.y), static_cast<Real>(a.z)};
}

HOST_DEVICE inline Vec3d to_double(Vector3<float> a) { return {a.x, a.y, a.z}; }
HOST_DEVICE inline Vec3d to_double(Vec3d a) { return a; }

template <class T>
HOST_DEVICE T square(T a) {
  return a * a;
}

template <class T>
HOST_DEVICE T smaller(T a, T b) {
  return b < a ? b : a;
}

template <class T>
HOST_DEVICE T larger(T a, T b) {
  return a < b ? b : a;
}

// Four numbers that a GPU loads at once.
struct alignas(4 * sizeof(Real)) Quad {
  Real x{}, y{}, z{}, w{};
};

HOST_DEVICE inline Vec3 xyz(Quad q) { return {q.x, q.y, q.z}; }
HOST_DEVICE inline Quad quad(Vec3 v, Real w) { return {v.x, v.y, v.z, w}; }

// Symmetric 3x3 matrix.
template <class T>
struct SymmetricMatrix3 {
  T xx{}, yy{}, zz{}, xy{}, xz{}, yz{};

  // Adds weight s s^T.
  HOST_DEVICE void add_outer(T weight, Vector3<T> s) {
    const T x = weight * s.x, y = weight * s.y;
    xx += x * s.x, yy += y * s.y, zz += weight * s.z * s.z;
    xy += x * s.y, xz += x * s.z, yz += y * s.z;
  }
  HOST_DEVICE SymmetricMatrix3& operator+=(const SymmetricMatrix3& b) {
    xx += b.xx, yy += b.yy, zz += b.zz, xy += b.xy, xz += b.xz, yz += b.yz;
    return *this;
  }
  HOST_DEVICE void add_diagonal(T d) { xx += d, yy += d, zz += d; }
  HOST_DEVICE Vector3<T> operator*(Vector3<T> v) const {
    return {xx * v.x + xy * v.y + xz * v.z, xy * v.x + yy * v.y + yz * v.z, xz * v.x + yz * v.y + zz * v.z};
  }

  // Solution x of M x = b for a positive definite matrix, by its factors L D L^T.
  HOST_DEVICE Vector3<T> solve(Vector3<T> b) const {
    const T l21 = xy / xx, l31 = xz / xx;
    const T d2 = yy - l21 * xy;
    const T l32 = (yz - l21 * xz) / d2;
    const T d3 = zz - l31 * xz - l32 * l32 * d2;
    const T y = b.y - l21 * b.x;
    const T z = (b.z - l31 * b.x - l32 * y) / d3;
    const T second = y / d2 - l32 * z;
    return {b.x / xx - l21 * second - l31 * z, second, z};
  }
};

using Symmetric3 = SymmetricMatrix3<Real>;

}  // namespace slagflow
