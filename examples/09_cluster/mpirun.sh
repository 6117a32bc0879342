#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A sweep by MPI: each rank takes runs as it gets done with others.
#
#   mpirun.sh SUITE DIR N [mpirun's options, such as --hostfile hosts]
#
# Within a Slurm job, `srun tagfield_sweep_mpi SUITE --out DIR` does as well where Slurm knows MPI.
set -euo pipefail
suite=$1
folder=$2
ranks=$3
shift 3
exec mpirun -np "$ranks" "$@" "${TAGFIELD_SWEEP_MPI:-tagfield_sweep_mpi}" "$suite" --out "$folder"
