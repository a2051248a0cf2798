void cyclic(void)
{
	v.cycles = v.cycles + 1;
	switch (v.step) {
	case 0:
		v.motor = 0;
		v.brake = 1;
		v.ticks = 0;
		v.step = 10;
		break;
	case 10:
		v.brake = 0;
		v.motor = 1;
		v.step = 20;
		break;
	case 20: case 21:
		v.speed = v.speed + 7;
		v.ticks = v.ticks + 1;
		if (v.speed > 100) {
			v.step = 30;
		}
		break;
	case 30 ... 39:
		v.ticks = v.ticks + 1;
		if (v.ticks > 40) {
			v.step = 40;
		} else {
			v.step = 30 + v.ticks % 10;
		}
		break;
	case 40:
		v.speed = v.speed - 15;
		if (v.speed < 0) {
			v.speed = 0;
			v.step = 50;
		}
		break;
	case 50:
		v.motor = 0;
		v.faults = v.faults + 1;
		if (v.faults % 16 == 0) {
			v.step = 1000;
		} else {
			v.step = 0;
		}
		break;
	case 1000:
		v.brake = 1;
		v.step = 0;
		break;
	default:
		v.faults = v.faults + 1000;
		v.step = 0;
	}
}
