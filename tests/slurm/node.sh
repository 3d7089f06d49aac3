#!/usr/bin/env bash
# Starts and stops a one-node SLURM on loopback, without systemd: node.sh start|stop FOLDER. Debian, as root.
# Its configuration must be /etc/slurm/slurm.conf: Snakemake's executor takes SLURM_CONF from the environment of jobs.
set -euo pipefail
CONF=/etc/slurm/slurm.conf
MARK="# one-node SLURM of subslide's tests"
NODE=$(hostname -s)

alive() { [ -s "$1" ] && kill -0 "$(cat "$1")" 2>/dev/null; }
refuse() { echo "test-slurm: $1" >&2; exit 2; }

ready() {
  [ "$(id -u)" = 0 ] || refuse "SLURM's daemons need root; allowed: sudo make test-slurm, or a container"
  if [ -e "$CONF" ] && ! grep -qxF "$MARK" "$CONF"; then
    refuse "$CONF is another SLURM's, and is left alone; allowed: a machine without SLURM"
  fi
  command -v slurmctld slurmd munged sbatch >/dev/null && return
  command -v apt-get >/dev/null || refuse "slurmctld, slurmd and munged are missing; allowed: Debian, or install them"
  echo "test-slurm: installing slurm-wlm and munge by apt"
  { apt-get update -q && DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends slurm-wlm munge; } \
    > "$ROOT/apt.log" 2>&1 || { tail -n 3 "$ROOT/apt.log" >&2; refuse "slurm-wlm and munge cannot be installed"; }
}

munge_up() {  # one that runs already is used, and left
  munge -n 2>/dev/null | unmunge >/dev/null 2>&1 && return
  install -d -o munge -g munge -m 0755 /run/munge
  install -d -o munge -g munge -m 0700 "$ROOT/munge"
  head -c 1024 /dev/urandom > "$ROOT/munge/key"
  chown munge:munge "$ROOT/munge/key"
  chmod 0400 "$ROOT/munge/key"
  setpriv --reuid=munge --regid=munge --clear-groups munged --force --key-file="$ROOT/munge/key" \
    --pid-file="$ROOT/munge/pid" --log-file="$ROOT/munge/log" --seed-file="$ROOT/munge/seed"
  munge -n | unmunge >/dev/null
}

configure() {
  mkdir -p "$(dirname "$CONF")" "$ROOT"/state "$ROOT"/spool
  cat > "$CONF" <<C
$MARK
ClusterName=subslide
SlurmctldHost=$NODE(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=2,batch_sched_delay=0,bf_interval=2
ReturnToService=2
SlurmdTimeout=10
SlurmctldPidFile=$ROOT/slurmctld.pid
SlurmdPidFile=$ROOT/slurmd.pid
SlurmctldLogFile=$ROOT/slurmctld.log
SlurmdLogFile=$ROOT/slurmd.log
StateSaveLocation=$ROOT/state
SlurmdSpoolDir=$ROOT/spool
SlurmctldPort=16817
SlurmdPort=16818
SlurmdParameters=config_overrides
MinJobAge=300
KillWait=5
NodeName=$NODE NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$(awk '/MemTotal/{print int($2/1024*0.8)}' /proc/meminfo)
PartitionName=debug Nodes=$NODE Default=YES MaxTime=INFINITE State=UP
C
}

case "${1:-}" in
  start)
    ROOT=$2
    mkdir -p "$ROOT"
    ready
    munge_up
    configure
    alive "$ROOT/slurmctld.pid" || slurmctld
    alive "$ROOT/slurmd.pid" || slurmd -N "$NODE"
    for _ in $(seq 60); do
      [ "$(sinfo -h -o %T 2>/dev/null)" != idle ] || exit 0
      sleep 0.5
    done
    sinfo -R >&2 || true
    tail -n 5 "$ROOT"/*.log >&2
    exit 1
    ;;
  node)  # its daemon again, after it was killed
    ROOT=$2
    alive "$ROOT/slurmd.pid" || slurmd -N "$NODE"
    ;;
  stop)
    ROOT=$2
    scancel --me 2>/dev/null || true
    for pid in "$ROOT"/slurmd.pid "$ROOT"/slurmctld.pid "$ROOT"/munge/pid; do
      if alive "$pid"; then
        kill "$(cat "$pid")"
        for _ in $(seq 40); do alive "$pid" || break; sleep 0.25; done
      fi
    done
    rmdir /run/munge 2>/dev/null || true
    if [ -e "$CONF" ] && grep -qxF "$MARK" "$CONF"; then rm "$CONF"; fi
    ;;
  *) refuse "node.sh start|node|stop FOLDER" ;;
esac
