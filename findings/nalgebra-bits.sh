#!/usr/bin/env bash
# Does one compiled Rust program give the same bits of a matrix product on every processor?
#
# A good guess: yes. rustc compiles for the oldest x86-64 unless told otherwise, it never fuses
# a*b + c by itself, the program has one thread and no random numbers, and nalgebra is plain
# Rust. One binary, one input: one answer.
#
# What happens (nalgebra 0.35.0, matrixmultiply 0.3.11; 2026-11-28): nalgebra's default feature
# `std` hands products of matrices larger than five by five to matrixmultiply, which looks at
# the processor while the program runs and takes a kernel with fused multiply-add where there
# is one. The same binary then rounds otherwise on a processor of 2008 than on a newer one.
# Five beads show nothing, ten do; the eigenvectors are the same on both, their product is
# not. Without `std` (feature `libm` in its place) the bits are the same on both.
#
# What it means: a test that holds modes of a bead column to recorded bits passes on the
# machine that recorded them and on its like, and fails elsewhere. Any other crate of a build
# that asks for nalgebra with its default features turns `std` on for all. beadlab takes
# nalgebra without `std`. Whoever needs speed more than bits does well to keep it.
#
# Both processors are emulated (qemu-user), so that any x86-64 machine can show it; the binary
# is run as it is. Needs Debian 12 (amd64, after apt-get update) and cargo.
set -euo pipefail
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
cd "$dir"
apt-get download -qq -o APT::Sandbox::User=root 'qemu-user-static=1:7.2+dfsg-7+deb12u18+b2'
dpkg -x ./*.deb .
export CARGO_TARGET_DIR="$dir/target"
mkdir src
cat > Cargo.toml <<'TOML'
[package]
name = "product"
version = "0.0.0"
edition = "2021"
[features]
std = ["nalgebra/std", "dep:matrixmultiply"]
libm = ["nalgebra/libm"]
[dependencies]
nalgebra = { version = "=0.35.0", default-features = false, features = ["alloc"] }
matrixmultiply = { version = "=0.3.11", optional = true }
TOML
cat > src/main.rs <<'RUST'
use nalgebra::{DMatrix, SymmetricEigen};
fn bits(numbers: &DMatrix<f64>) -> u64 {
    numbers.iter().fold(0, |all: u64, number| all.rotate_left(5) ^ number.to_bits())
}
fn main() {
    // The springs of equal beads on a floor, taken apart into modes and put together again.
    for beads in [5, 10] {
        let springs = DMatrix::from_fn(beads, beads, |i: usize, j| match i.abs_diff(j) {
            0 => if i + 1 == beads { 1.0 } else { 2.0 },
            1 => -1.0,
            _ => 0.0,
        });
        let modes = SymmetricEigen::new(springs.clone());
        let vectors = modes.eigenvectors;
        let again = &vectors * DMatrix::from_diagonal(&modes.eigenvalues) * vectors.transpose();
        let (before, after, error) = (bits(&vectors), bits(&again), (again - springs).norm());
        println!("{beads} beads: vectors {before:016x}, product {after:016x}, error {error:e}");
    }
}
RUST
for feature in std libm; do
    cargo build -q --features "$feature"
    cp target/debug/product "$feature"
    for processor in Nehalem max; do
        usr/bin/qemu-x86_64-static -cpu "$processor" "./$feature" > "$feature.$processor"
        sed "s/^/$feature, $processor: /" "$feature.$processor"
    done
done
# Five beads, and the vectors of ten, are the same with and without fused multiply-add.
cmp <(sed '/^10/s/product.*//' std.Nehalem) <(sed '/^10/s/product.*//' std.max)
if cmp -s std.Nehalem std.max; then
    echo "the product no longer depends on the processor"
    exit 1
fi
cmp libm.Nehalem libm.max
