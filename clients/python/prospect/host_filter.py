"""Which datagrams of a bus are heard, as services/common/host_filter.h says: those sent to its multicast group alone, and, with
ttl=0, only those that this machine sent. A filter in the kernel (socket(7), SO_ATTACH_FILTER; needs no rights)."""
import ctypes
import socket
import struct

SO_ATTACH_FILTER = 26
LOAD, IF_EQUAL, END = 0x20, 0x15, 0x06  # BPF_LD | BPF_W | BPF_ABS; BPF_JMP | BPF_JEQ; BPF_RET
DESTINATION = 0xFFF00000 + 16  # SKF_NET_OFF: in the IP header
PACKET_KIND, INTERFACE = 0xFFFFF000 + 4, 0xFFFFF000 + 8  # SKF_AD_OFF
PACKET_LOOPBACK = 5
ALL, NOTHING = 0xFFFFFFFF, 0


def attach(sock, group, this_machine_only):
    """To be called before the socket is bound, so that nothing unfiltered is ever queued. Raises OSError where it fails."""
    wanted = struct.unpack(">I", socket.inet_aton(group))[0]
    steps = [(LOAD, 0, 0, DESTINATION), (IF_EQUAL, 1, 0, wanted), (END, 0, 0, NOTHING)]
    if this_machine_only:
        # By the loopback interface, or a copy of what went out by another.
        steps += [(LOAD, 0, 0, INTERFACE), (IF_EQUAL, 3, 0, socket.if_nametoindex("lo")), (LOAD, 0, 0, PACKET_KIND),
                  (IF_EQUAL, 1, 0, PACKET_LOOPBACK), (END, 0, 0, NOTHING)]
    steps.append((END, 0, 0, ALL))
    program = ctypes.create_string_buffer(b"".join(struct.pack("=HBBI", *step) for step in steps))
    sock.setsockopt(socket.SOL_SOCKET, SO_ATTACH_FILTER, struct.pack("@HP", len(steps), ctypes.addressof(program)))
