#!/bin/sh
# A drive on any number of GPUs of a Slurm cluster: sbatch configs/slurm.sh. No MPI library is needed.
# Ranks share the folder of outputs, which all nodes must see, and take shards of frames from it until none is left; the
# last one merges. Submitted again after a time limit or a crash, it goes on where it was.
#SBATCH --job-name=wavetracer
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=4
#SBATCH --gpus-per-task=1
#SBATCH --cpus-per-task=8
#SBATCH --time=04:00:00
#SBATCH --signal=INT@60
#SBATCH --requeue

# A minute before the time limit ranks are interrupted (--signal): what they have finished is whole.
exec srun wavetracer run -c drive.toml -o "$SLURM_SUBMIT_DIR/out/drive" --resume

# Without a folder that all nodes see, parts by themselves, counted from 0, joined later on any machine:
#   sbatch --array=0-7 --wrap 'wavetracer run -c drive.toml -o "part_$SLURM_ARRAY_TASK_ID" --shard "$SLURM_ARRAY_TASK_ID/8"'
#   wavetracer merge -o out/drive part_*
